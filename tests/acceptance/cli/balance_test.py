"""Load balancing through the programs: the same numbers whoever is responsible, and a bench that needs no ranks."""
import unittest

from support import FootwallTest

SHAPE = ("--size", "60x60x30", "--faces", 320, "--area", 200)


class Balance(FootwallTest):
    def test_same_checksum_for_every_balancer(self):
        project = self.synthetic(size="40x36x32")
        self.footwall("triangulate", project)
        wanted = self.footwall("extract", project, "--ranks", 1)
        for balance in ("minimal", "global=5", "local=0,cache", "manhattan=0,2"):
            run = self.footwall("extract", project, "--ranks", 3, "--balance", balance, "--exchange", "minimum")
            self.assertEqual((run["checksum"], run["balance"]), (wanted["checksum"], balance))
        error = self.refused(2, "extract", project, "--balance", "manhattan=1,0")
        self.assertIn("from 1", error["hint"])

    def test_bench_replays_many_ranks(self):
        done = self.footwall("bench", "balance", *SHAPE, "--ranks", "1,4,16", "--tau", "all")
        self.assertGreater(done["checked"], 10)
        rows = {(row["ranks"], row["balance"]): row for row in done["rows"]}
        self.assertEqual(rows[1, "none"]["load_deviation"], 0)
        self.assertEqual(rows[1, "none"]["remote_voxels"], 0)
        none, even = rows[16, "none"], rows[16, "global=0"]
        self.assertLess(even["load_deviation"], 0.5 * none["load_deviation"])
        self.assertGreater(even["remote_voxels"], none["remote_voxels"])
        self.assertGreater(even["moved_faces"], 0)
        self.assertLessEqual(rows[16, "minimal"]["predicted"]["total"], none["predicted"]["total"])
        self.assertIn((16, "manhattan=0,6"), rows)
        self.assertNotIn((16, "manhattan=0,7"), rows)
        self.assertIsNone(none["published_load_deviation"])

    def test_bench_takes_projects_and_scripts(self):
        project = self.synthetic(size="40x36x32")
        self.footwall("triangulate", project)
        done = self.footwall("bench", "balance", project, "--ranks", 4, "--strategy", "none;local=0,running",
                             "--pillars", "1x1,2x2", "--exchange", "reduce")
        self.assertEqual([(r["balance"], r["pillars"]) for r in done["rows"]],
                         [("none", [1, 1]), ("local=0,running", [1, 1]), ("none", [2, 2]), ("local=0,running", [2, 2])])
        self.assertGreater(done["faces"], 50)
        for wrong in (("bench", "balance"), ("bench", "balance", project, *SHAPE),
                      ("bench", "balance", *SHAPE, "--strategy", "sideways"), ("bench", "balance", *SHAPE, "--ranks", "0"),
                      ("bench", "balance", *SHAPE, "--pillars", "2"), ("bench", "balance", *SHAPE, "--exchange", "none")):
            self.assertEqual(self.refused(2, *wrong)["code"], "usage")


if __name__ == "__main__":
    unittest.main()

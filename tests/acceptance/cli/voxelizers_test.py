"""footwall bench voxelize in its four modes, and extract with other voxelizers."""
import math
import pathlib
import unittest

from support import FootwallTest

TRIPLE = ("15,12,5", "10,5,2", "4,3,6")


class Voxelizers(FootwallTest):
    def bench(self, *arguments):
        return self.footwall("bench", "voxelize", *arguments)

    def text(self, *arguments):
        done = self.start(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def triangles(self):
        pathlib.Path(self.path("t.csv")).write_text("".join(
            f"{n}.25,3,{40 - n},{60 + n},20,7,{n},{50 + n}.5,33\n" for n in range(12)))
        return "t.csv"

    def test_differences_from_exact_are_printed(self):
        exact = self.bench("--triangles", self.triangles(), "--repeats", 1)
        self.assertNotIn("differences", exact)
        for name in ("rotated", "rotated=plain", "kaufman"):
            bench = self.bench("--triangles", "t.csv", "--repeats", 1, "--voxelizer", name)
            found = bench["differences"]
            self.assertEqual(found["triangles"], 12)
            self.assertEqual(found["exact_voxels"], exact["voxels"])
            # What exact has and the method has not, and the other way round, make up the difference.
            self.assertEqual(bench["voxels"], exact["voxels"] - found["missed"] + found["extra"])
            self.assertAlmostEqual(found["missed_percent"], 100 * found["missed"] / exact["voxels"])
            self.assertEqual(found["duplicates"] == 0, name == "kaufman")
        text = self.text("bench", "voxelize", "--triangles", "t.csv", "--voxelizer", "kaufman")
        self.assertIn("missed", text)
        self.assertIn("duplicates", text)

    def test_one_triple_is_the_seeds_sample_run(self):
        bench = self.bench("--vertices", *TRIPLE, "--runs", 2, "--voxelizer", "rotated", "--threads", "1,2")
        self.assertEqual(bench["triangles"], 512)
        self.assertEqual([row["threads"] for row in bench["rows"]], [1, 2])
        row = bench["rows"][0]
        for key, printed in (("mean_area", 100.67522), ("max_area", 192.60841), ("min_area", 17.83255)):
            self.assertAlmostEqual(row[key], printed, delta=1e-3)
        self.assertAlmostEqual(row["wall_seconds_per_triangle"], row["wall_seconds"] / 512)
        self.assertEqual(bench["rows"][1]["voxels"], row["voxels"])
        text = self.text("bench", "voxelize", "--vertices", *TRIPLE, "--runs", 1, "--one-triangle")
        self.assertIn("Average/max/min triangle area", text)
        # Nine negative signs are no options.
        self.bench("--vertices", "-1,-2,-3", "-20,-2,-3", "-1,-20,-3", "--runs", 1)

    def test_the_table_stands_beside_the_published_one(self):
        arguments = ("--table", "--areas", "10,1000", "--runs", 1, "--threads", "1,2")
        bench = self.bench(*arguments, "--output", "spans")
        self.assertEqual([(row["asked_area"], row["threads"]) for row in bench["rows"]],
                         [(10, 1), (10, 2), (1000, 1), (1000, 2)])
        for row in bench["rows"]:
            self.assertLess(abs(math.log(row["mean_area"] / row["asked_area"])), 0.01)
        self.assertEqual(bench["published"]["areas"][-1], 5e6)
        self.assertEqual(len(bench["published"]["wall"]), 12)
        text = self.text("bench", "voxelize", *arguments)
        self.assertIn("Xeon: cpu-voxelize-1cpu", text)
        self.assertIn("here: exact, 2 threads", text)

    def test_gather_from_the_cache(self):
        bench = self.bench("--gather", "cache", "--areas", "1000", "--runs", 1)
        self.assertGreater(bench["checked_faces"], 10)
        self.assertGreater(bench["rows"][0]["folded_ordered_per_second"], 0)

    def test_extract_gives_the_same_numbers_on_any_ranks(self):
        project = self.synthetic()
        seen = set()
        for name in ("rotated", "rotated=plain", "kaufman", "exact"):
            sums = {self.footwall("extract", project, "--voxelizer", name, "--ranks", ranks, "--threads", threads,
                                  "--exchange", exchange)["checksum"]
                    for ranks, threads, exchange in ((1, 1, "reduce"), (3, 2, "reduce"), (2, 1, "minimum"))}
            self.assertEqual(len(sums), 1, name)
            seen |= sums
        self.assertEqual(len(seen), 3)  # both loops of `rotated` are one method
        self.refused(2, "extract", project, "--voxelizer", "gpu")
        self.refused(2, "extract", project, "--voxelizer", "exact=3")

    def test_wrong_usage(self):
        for arguments in ((), ("--table", "--gather", "cache"), ("--table", "--voxelizer", "gpu"),
                          ("--table", "--voxelizer", "rotated=fast"), ("--vertices", "1,2", "3,4,5", "6,7,8"),
                          ("--table", "--runs", 0), ("--gather", "disk")):
            self.refused(2, "bench", "voxelize", *arguments)
        self.assertIn("round", self.refused(2, "bench", "voxelize", "--table", "--voxelizer", "gpu")["message"])
        self.refused(2, "bench", "voxelize", "--triangles", self.triangles(), "--threads", "1,2")


if __name__ == "__main__":
    unittest.main()

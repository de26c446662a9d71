"""Scripted workloads: made alike, run alike on any ranks, reported as the seed's programs do."""
import re
import unittest

from support import FootwallTest


class Workload(FootwallTest):
    def test_sample_run_of_the_seed(self):
        made = self.footwall("workload", "make", "104x104x100", 200, 96, 2, 10, 10, "w.fww")
        self.assertAlmostEqual(made["mean_area"], 200, delta=10)
        wanted = {"adds": 1120, "removes": 1440, "moves": 1440, "extracts": 20}
        self.assertLessEqual(wanted.items(), made["operations"].items())
        one = self.footwall("workload", "run", "w.fww", "--ranks", 1)
        self.assertLessEqual(wanted.items(), one["operations"].items())
        self.assertEqual(len(one["repeats"]), 10)
        self.assertEqual(one["faces"], 20 * 112)
        self.assertGreater(one["voxels"], one["faces"] * 200)
        for ranks, exchange in ((2, "minimum"), (3, "reduce")):
            run = self.footwall("workload", "run", "w.fww", "--ranks", ranks, "--exchange", exchange)
            self.assertEqual((run["checksum"], run["ranks"]), (one["checksum"], ranks))
            self.assertEqual([r["checksum"] for r in run["repeats"]], [r["checksum"] for r in one["repeats"]])
            self.assertGreaterEqual(run["slowest_rank"], run["quickest_rank"])
            self.assertGreater(run["bytes_sent"], 0)
            for key in ("faces", "voxels", "ranks", "threads", "exchange", "balance", "voxelizer", "seconds", "bytes_sent",
                        "messages", "load_max_over_mean", "load_deviation", "checksum", "cache_hits"):
                self.assertIn(key, run)
        other = self.footwall("workload", "run", "w.fww", "--ranks", 1, "--seed", 2)
        self.assertNotEqual(other["checksum"], one["checksum"])

    def test_words_of_the_sample_run(self):
        self.footwall("workload", "make", "30x30x30", 20, 8, 1, 2, 1, "w.fww", "--meshes", 2)
        text = self.start("workload", "run", "w.fww", "--ranks", 1).stdout
        for line in ("Add operations", "Remove operations", "Move operations", "Extract-All/compute operations",
                     "Average load StDev over all cycles"):
            self.assertRegex(text, "--- " + re.escape(line) + r"\.*: [0-9.]+\n")
        for line in ("Slowest node took", "Quickest node took"):
            self.assertRegex(text, line + r"\.*: [0-9.]+ Per Repeat: [0-9.]+\n")

    def test_refusals(self):
        self.refused(2, "workload", "make", "30x30", 20, 8, 1, 2, 1, "w.fww")
        self.refused(2, "workload", "make", "30x30x30", 0, 8, 1, 2, 1, "w.fww")
        self.assertEqual(self.refused(1, "workload", "run", "none.fww")["code"], "not_found")
        with open(self.path("bad.fww"), "w") as file:
            file.write("footwall-workload 1\nsize 9 9 9\nrepeat\ndestroy 0\n")
        error = self.refused(1, "workload", "run", "bad.fww", "--ranks", 2)
        self.assertEqual(error["code"], "invalid")
        self.assertIn("there is no mesh 0", error["message"])
        self.assertIn("docs/workloads.md", error["hint"])
        self.assertIn("lot", self.refused(2, "workload", "run", "bad.fww", "--snr", 30)["hint"])
        self.refused(2, "workload", "run", "bad.fww", "--balance", "fair")
        self.refused(2, "workload", "run", "bad.fww", "--interleave", "2")

    def test_faces_larger_than_the_survey_are_told(self):
        done = self.start("workload", "make", "9x9x9", 5000, 8, 1, 2, 1, "w.fww", "--meshes", 2)
        self.assertEqual(done.returncode, 0)
        self.assertIn("do not lie wholly inside the survey", done.stderr)


if __name__ == "__main__":
    unittest.main()

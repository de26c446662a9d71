"""footwall bench visible: the same passes for any number of ranks, tables, errors."""
import unittest

from support import FootwallTest


class BenchVisible(FootwallTest):
    SMALL = ("--picture", "120x90", "--repeat", 1)

    def test_every_number_of_ranks_makes_the_same_passes(self):
        answer = self.footwall("bench", "visible", "--synthetic", "sphere", "--size", 60, "--ranks", "1,2,3,5", "--mode", "paper",
                               "--view", "30,25", "--view", "-100,40", *self.SMALL)
        self.assertEqual([run["ranks"] for run in answer["runs"]], [1, 2, 3, 5])
        first = answer["runs"][0]
        self.assertEqual(len(first["rows"]), 4)
        for run in answer["runs"]:
            for row, row_of_one in zip(run["rows"], first["rows"]):
                self.assertEqual([(p["cells"], p["triangles"]) for p in row["passes"]],
                                 [(p["cells"], p["triangles"]) for p in row_of_one["passes"]])
                whole = run["whole"][row["view"]]
                self.assertLess(row["triangles"], whole["triangles"])
                self.assertGreaterEqual(row["triangles"], whole["triangles_seen"])
                self.assertEqual(row["triangles"], sum(p["triangles"] for p in row["passes"]))
                self.assertEqual((row["pixels"], row["pixels_lost"]), (whole["pixels"], 0))
                self.assertTrue(row["finished"])
                self.assertEqual(row["passes"][-1]["percent"], 100)
                self.assertEqual(row["passes"][-1]["uncovered_pixels"], 0)
                self.assertGreater(row["passes"][0]["uncovered_pixels"], 0)
        self.assertTrue(all(row["load_difference"] == 0 for row in first["rows"]))
        self.assertTrue(all(row["load_difference"] < 0.2 for row in answer["runs"][1]["rows"]))

    def test_mode_depth_is_the_whole_picture(self):
        answer = self.footwall("bench", "visible", "--synthetic", "envelope", "--size", 48, "--ranks", "1,3", *self.SMALL)
        self.assertEqual([(run["mode"], run["ranks"]) for run in answer["runs"]],
                         [("depth", 1), ("depth", 3), ("paper", 1), ("paper", 3)])
        for run in answer["runs"][:2]:
            self.assertEqual(len(run["rows"]), 2)
            for row in run["rows"]:
                self.assertEqual((row["pixels_farther"], row["pixels_lost"]), (0, 0))
                self.assertEqual(row["pixels"], run["whole"][row["view"]]["pixels"])
                self.assertLess(row["triangles"], run["whole"][row["view"]]["triangles"])

    def test_it_prints_the_tables_of_the_paper(self):
        words = self.start("bench", "visible", "--synthetic", "sphere", "--size", 40, "--ranks", "1,4", *self.SMALL)
        self.assertEqual(words.returncode, 0, words.stderr)
        for title in ("table 1", "tables 2 and 3, figures 7 and 8", "figure 9", "table 4",
                      "tables 5 and 6, figures 10 and 11: view 2, 4 ranks"):
            self.assertIn(title, words.stdout)

    def test_an_empty_surface_takes_no_pass(self):
        answer = self.footwall("bench", "visible", "--synthetic", "sphere", "--size", 24, "--value", 1000, "--ranks", 2,
                               "--mode", "paper", *self.SMALL)
        row = answer["runs"][0]["rows"][0]
        self.assertEqual((row["triangles"], row["passes"], row["pixels"]), (0, [], 0))
        words = self.start("bench", "visible", "--synthetic", "sphere", "--size", 24, "--value", 1000, "--ranks", 2,
                           *self.SMALL)
        self.assertEqual(words.returncode, 0, words.stderr)

    def test_what_cannot_be_is_refused(self):
        for wrong in (("--mode", "guess"), ("--cell", "0"), ("--cell", "8x8"), ("--estimate-cell", "33"), ("--view", "30"),
                      ("--ranks", "0"), ("--ranks", "1,x"), ("--repeat", "0"), ("--threads", "0"), ("--picture", "0x10")):
            error = self.refused(2, "bench", "visible", "--synthetic", "sphere", "--size", 24, "--ranks", 1, *wrong)
            self.assertTrue(error["message"])
        self.refused(2, "bench", "visible", "--ranks", 1)


if __name__ == "__main__":
    unittest.main()

"""footwall bench service: right numbers, a table with every figure and its goal, refusals."""
import unittest

from support import FootwallTest

SMALL = ("--faces", 200, "--many-faces", 50, "--batches", 2, "--rings", 3, "--starts", 1, "--idle", 0.2)
FEW = ("--moves", 20, "--memory-moves", 30)


class BenchService(FootwallTest):
    def test_every_figure_has_its_goal(self):
        answer = self.footwall("bench", "service", "--ranks", 3, "--pictures", 2, "--volume", 3, *SMALL, *FEW)
        self.assertTrue(answer["checked"])
        goals = {figure["name"]: figure["goal"] for figure in answer["figures"]}
        self.assertEqual(goals, {"start_p99": 1, "idle": 1, "move_p99": 5, "batch_median": 30, "memory_growth": 1,
                                 "next_picture": None, "serve_ready": 3})
        for figure in answer["figures"]:
            with self.subTest(figure=figure["name"]):
                if figure["goal"] is None:
                    self.assertIsNone(figure["met"])
                else:
                    self.assertEqual(figure["met"], figure["value"] < figure["goal"])
                if figure["name"] in ("move_p99", "batch_median", "start_p99", "next_picture", "serve_ready"):
                    self.assertGreater(figure["value"], 0)

    def test_parts_can_be_left_out(self):
        words = self.start("bench", "service", "--ranks", 1, "--pictures", 0, "--volume", 0, *SMALL, *FEW)
        self.assertEqual(words.returncode, 0, words.stderr)
        self.assertIn("1 vertex moved", words.stdout)
        self.assertNotIn("picture", words.stdout)
        self.assertNotIn("serve", words.stdout)

    def test_thousands_of_moves_take_no_memory(self):
        answer = self.footwall("bench", "service", "--ranks", 2, "--pictures", 0, "--volume", 0, *SMALL, "--moves", 500,
                               "--memory-moves", 4500)
        growth = {figure["name"]: figure["value"] for figure in answer["figures"]}["memory_growth"]
        self.assertLess(growth, 2)  # MiB: half a KiB for each move, of the process that grew most

    def test_what_cannot_be_measured_is_refused(self):
        for wrong in (("--moves", 0), ("--volume", -1), ("--faces", 10, "--many-faces", 20)):
            with self.subTest(wrong=wrong):
                self.refused(2, "bench", "service", *wrong)


if __name__ == "__main__":
    unittest.main()

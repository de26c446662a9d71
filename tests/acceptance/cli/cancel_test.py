"""Ctrl+C of the commands that have surfaces made and drawn by the engine: they end, and leave nothing behind."""
import os
import signal
import unittest

from processes import HeldRuns, go_on


class Cancel(HeldRuns):
    def check(self, ranks, *command, once=lambda: True):
        """Stops a run, cancels it and lets it go on."""
        before = sorted(os.listdir(self.folder))
        program, below, _ = self.held(ranks, *command, once=once)
        program.send_signal(signal.SIGINT)
        go_on(below)
        _, words = program.communicate(timeout=120)
        self.assertEqual(program.returncode, 130, words)
        self.assertIn("footwall: cancelled", words)
        self.assert_gone(below)
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        self.assertEqual(os.listdir(self.folder / "tmp"), [])

    def test_nothing_is_left(self):
        project = self.synthetic(size="128x128x128")
        for ranks in (1, 3):
            for command in (("isosurface", project, "--value", "0.2", "--out", "s.h5"),
                            ("isosurface", project, "--value", "0.2", "--out", "s.vtp"),
                            ("render", project, "--isosurface", "amplitude=0.2", "--size", "1600x1600", "--out", "p.png",
                             "--depth", "p.tif")):
                with self.subTest(command=command, ranks=ranks):
                    self.check(ranks, *command)

    def test_what_can_be_seen_ends_between_its_passes(self):
        project = self.synthetic(size="128x128x128")
        (self.folder / "passes").mkdir()
        seen = ("--visible", "--camera", "30,20,1", "--size", "800x800", "--pass-images", "passes", "--mode")
        isosurface = ("isosurface", project, "--value", "0.2", "--out", "s.vtp")
        render = ("render", project, "--isosurface", "amplitude=0.2", "--out", "p.png")
        for ranks, command, mode in ((1, isosurface, "depth"), (3, isosurface, "depth"), (2, isosurface, "paper"),
                                     (1, render, "depth"), (3, render, "depth")):
            with self.subTest(ranks=ranks, command=command, mode=mode):
                self.check(ranks, *command, *seen, mode, once=lambda: any((self.folder / "tmp").glob("*/pass-1")))
                self.assertEqual(os.listdir(self.folder / "passes"), [])


if __name__ == "__main__":
    unittest.main()

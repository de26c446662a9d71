"""Ctrl+C of the commands that have surfaces made and drawn by the engine: they end, and leave nothing behind."""
import os
import select
import signal
import subprocess
import unittest

from jobs_test import children, is_rank
from support import BIN, FootwallTest


class Cancel(FootwallTest):
    def stopped(self, ranks, *arguments):
        """A run of the program whose ranks were found and stopped, so that it cannot end by itself: (process, ranks)."""
        program = subprocess.Popen([str(BIN / "footwall"), *arguments, "--ranks", str(ranks)], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, cwd=self.folder,
                                   env={**os.environ, "TMPDIR": self.path("tmp")})
        found = []
        while len(found) < ranks and program.poll() is None:
            found = [process for process in children(program.pid) if is_rank(process)]
        for rank in found:
            os.kill(rank, signal.SIGSTOP)
        self.assertIsNone(program.poll(), "it ended before it could be stopped")
        return program, found

    def assert_gone(self, processes):
        """Waits, without sleeping, until none of them runs: the last may be on its way out."""
        for process in processes:
            try:
                descriptor = os.pidfd_open(process)
            except ProcessLookupError:
                continue
            try:
                self.assertTrue(select.select([descriptor], [], [], 60)[0], f"process {process} outlived the program")
            finally:
                os.close(descriptor)

    def test_nothing_is_left(self):
        project = self.synthetic(size="128x128x128")
        (self.folder / "tmp").mkdir()
        before = sorted(os.listdir(self.folder))
        for ranks in (1, 3):
            for command in (("isosurface", project, "--value", "0.2", "--out", "s.h5"),
                            ("isosurface", project, "--value", "0.2", "--out", "s.vtp"),
                            ("render", project, "--isosurface", "amplitude=0.2", "--size", "1600x1600", "--out", "p.png",
                             "--depth", "p.tif")):
                with self.subTest(command=command, ranks=ranks):
                    program, below = self.stopped(ranks, *command)
                    below += children(program.pid)
                    program.send_signal(signal.SIGINT)
                    for rank in below:
                        try:
                            os.kill(rank, signal.SIGCONT)
                        except ProcessLookupError:
                            pass
                    _, words = program.communicate(timeout=120)
                    self.assertEqual(program.returncode, 130, words)
                    self.assertIn("footwall: cancelled", words)
                    self.assert_gone(below)
                    self.assertEqual(sorted(os.listdir(self.folder)), before)
                    self.assertEqual(os.listdir(self.folder / "tmp"), [])


if __name__ == "__main__":
    unittest.main()

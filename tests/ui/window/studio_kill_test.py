"""footwall-studio itself killed with kill -9 while somebody clicks at random: the project is whole, with all that was stored.

on_a_screen.py studio_kill_test.py RANDOM_EDITOR. FOOTWALL_TEST_FACTOR times as many kills where that is set.
"""
import os
import pathlib
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

EDITOR = sys.argv.pop(1)
STUDIO = pathlib.Path(os.environ["FOOTWALL_BIN"]) / "footwall-studio"
KILLS = max(1, int(os.environ.get("FOOTWALL_TEST_FACTOR", "1")))
PATIENCE = 120  # seconds


def xdotool(*words):
    return subprocess.run(["xdotool", *map(str, words)], capture_output=True, text=True)


class StudioKillTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="footwall-kill-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.project = self.folder / "s.footwall"
        subprocess.run([EDITOR, "new", str(self.project)], check=True)

    def steps(self):
        """Steps of the history on disk, as a reader sees them."""
        with sqlite3.connect(f"file:{self.project}?mode=ro", uri=True) as database:
            return database.execute("SELECT count(*) FROM edit").fetchone()[0]

    def window_of(self, studio):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            self.assertIsNone(studio.poll(), "the editor ended by itself")
            found = xdotool("search", "--onlyvisible", "--all", "--pid", studio.pid, "--name", "Footwall").stdout.split()
            if found:
                return found[-1]
            time.sleep(0.2)
        self.fail("no window came")

    def click_until_edits(self, studio, chance, edits):
        """Picks at random places until so many edits are stored."""
        window = self.window_of(studio)
        before = self.steps()
        end = time.monotonic() + PATIENCE
        while self.steps() < before + edits:
            self.assertLess(time.monotonic(), end, "no clicks came to edits")
            self.assertIsNone(studio.poll(), "the editor ended by itself")
            xdotool("windowfocus", window, "key", "shift+n", "key", "p")
            for _ in range(10):
                x, y = chance.randrange(280, 1300), chance.randrange(120, 800)
                if chance.random() < 0.3:
                    xdotool("mousemove", x, y, "mousedown", 1, "mousemove_relative", "--", chance.randrange(-60, 60),
                            chance.randrange(-60, 60), "mouseup", 1)
                else:
                    xdotool("mousemove", x, y, "click", 1)
                if chance.random() < 0.2:
                    xdotool("key", chance.choice(["ctrl+z", "ctrl+y", "Return", "x"]))

    def test_what_was_stored_is_there(self):
        chance = random.Random(int(os.environ.get("FOOTWALL_TEST_SEED", "8")))
        for kill in range(KILLS):
            studio = subprocess.Popen([str(STUDIO), str(self.project)], cwd=self.folder, stderr=subprocess.DEVNULL)
            self.addCleanup(studio.kill)
            self.click_until_edits(studio, chance, chance.randrange(3, 12))
            known = self.steps()
            studio.send_signal(signal.SIGKILL)
            self.assertEqual(studio.wait(), -signal.SIGKILL)
            look = subprocess.run([EDITOR, "look", str(self.project)], capture_output=True, text=True)
            self.assertEqual(look.returncode, 0, look.stderr)
            self.assertGreaterEqual(self.steps(), known)
            print(f"kill {kill}: {self.steps()} steps, the project is whole", flush=True)


if __name__ == "__main__":
    if shutil.which("xdotool") is None:
        print("SKIPPED: no xdotool")
        sys.exit(77)
    unittest.main()

"""kill -9 in the middle of editing: the project reopens whole, with every finished gesture.

kill_test.py RANDOM_EDITOR. FOOTWALL_TEST_FACTOR times as many kills where that is set.
"""
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

EDITOR = sys.argv.pop(1)
KILLS = 5 * max(1, int(os.environ.get("FOOTWALL_TEST_FACTOR", "1")))
SEED = int(os.environ.get("FOOTWALL_TEST_SEED", "8"))
MOST_GESTURES = 60  # before a kill is aimed; it comes some later
KNOWN_GESTURES = 300


class KillTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="footwall-kill-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def edit(self, project, seed):
        return subprocess.Popen([EDITOR, "edit", str(project), str(seed)], stdout=subprocess.PIPE, text=True)

    def copy(self, project, name):
        folder = self.folder / name
        folder.mkdir()
        shutil.copy(project, folder)
        return folder / project.name

    def digests(self, project, seed):
        """What the interpretation is after each gesture, where nothing kills the editor."""
        editor = self.edit(project, seed)
        lines = [editor.stdout.readline().split() for _ in range(KNOWN_GESTURES)]
        editor.kill()
        editor.communicate()
        self.assertEqual([line[0] for line in lines], [str(n) for n in range(len(lines))])
        return [line[1] for line in lines]

    def test_no_finished_gesture_is_lost(self):
        start = self.folder / "s.footwall"
        subprocess.run([EDITOR, "new", str(start)], check=True)
        chance = random.Random(SEED)
        expected, seed, in_flight = [], 0, 0
        for kill in range(KILLS):
            if kill % 20 == 0:
                seed = SEED + kill
                expected = self.digests(self.copy(start, f"whole-{kill}"), seed)
            project = self.copy(start, f"killed-{kill}")
            editor = self.edit(project, seed)
            told = [editor.stdout.readline() for _ in range(chance.randrange(1, MOST_GESTURES))]
            try:
                editor.wait(timeout=chance.random() * 0.03)
            except subprocess.TimeoutExpired:
                pass
            editor.send_signal(signal.SIGKILL)
            told += [line for line in editor.communicate()[0].splitlines(keepends=True) if line.endswith("\n")]
            self.assertEqual(editor.returncode, -signal.SIGKILL)
            with self.subTest(kill=kill, seed=seed):
                look = subprocess.run([EDITOR, "look", str(project)], capture_output=True, text=True)
                self.assertEqual(look.returncode, 0, look.stderr)
                found = look.stdout.strip()
                number, digest = int(told[-1].split()[0]), told[-1].split()[1]
                self.assertEqual(digest, expected[number])
                self.assertIn(found, expected[number:number + 2])
                in_flight += found != digest
            shutil.rmtree(project.parent)
        print(f"{KILLS} kills, {in_flight} of them after a commit that had not been told yet")


if __name__ == "__main__":
    unittest.main()

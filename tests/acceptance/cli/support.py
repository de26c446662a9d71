"""Runs the programs in a private folder and reads their answers."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

BIN = pathlib.Path(os.environ["FOOTWALL_BIN"])
SOURCE = pathlib.Path(os.environ["FOOTWALL_SOURCE"])


def test_data():
    """The folder of real files, or None where it is absent."""
    folder = pathlib.Path(os.environ.get("FOOTWALL_TEST_DATA", SOURCE.parent / "shared" / "data"))
    return folder if folder.is_dir() else None


class FootwallTest(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="footwall-test-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, name):
        return str(self.folder / name)

    def start(self, *arguments, stdin=None, env=None):
        """The finished process, whatever its exit status."""
        return subprocess.run([str(BIN / "footwall"), *map(str, arguments)], input=stdin, capture_output=True,
                              text=True, cwd=self.folder, timeout=300, env={**os.environ, **(env or {})})

    def footwall(self, *arguments, stdin=None, env=None):
        """The JSON answer of a command that must succeed."""
        done = self.start(*arguments, "--json", stdin=stdin, env=env)
        self.assertEqual(done.returncode, 0, f"footwall {' '.join(map(str, arguments))}\n{done.stdout}\n{done.stderr}")
        return json.loads(done.stdout)

    def refused(self, status, *arguments, stdin=None):
        """The error of a command that must fail with this exit status, in JSON and in words."""
        done = self.start(*arguments, "--json", stdin=stdin)
        self.assertEqual(done.returncode, status, f"{done.stdout}\n{done.stderr}")
        error = json.loads(done.stdout)["error"]
        self.assertIn(error["message"], done.stderr)
        return error

    def synthetic(self, name="s.footwall", size="40x36x32", seed=3):
        self.footwall("new", name, "--synthetic", "faulted", "--size", size, "--seed", seed)
        return name

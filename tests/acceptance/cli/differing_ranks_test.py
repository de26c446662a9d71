"""Ranks that no longer agree: the command's error says so, the engine ends in order and is started again."""
import json
import os
import shutil
import subprocess
import unittest

import served
from served import ServedTest, below


class DifferingRanks(ServedTest):
    def setUp(self):
        super().setUp()
        # A program takes the engine that stands beside it.
        programs = self.folder / "bin"
        programs.mkdir()
        shutil.copy(served.BIN / "footwall", programs / "footwall")
        shutil.copy(served.BIN / "differing_engine", programs / "footwall-engine")
        self.programs = programs

    def popen(self, *arguments, **how):
        return subprocess.Popen([str(self.programs / "footwall"), *map(str, arguments)], stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, cwd=self.folder,
                                env={**os.environ, **self.env}, **how)

    def test_the_error_is_clear_and_the_next_engine_works(self):
        project = self.synthetic()
        wanted = self.footwall("extract", project, "--ranks", 2)["checksum"]
        process = self.serve(project, "--connection", "e.json", wait_for="@e.json")
        family = below(process.pid)
        first = self.footwall("status", "@e.json")
        self.assertEqual(self.footwall("extract", project, "--engine", "@e.json")["checksum"], wanted)

        error = self.refused(1, "attribute", project, "--name", "a", "--engine", "@e.json")
        self.assertEqual(error["code"], "internal")
        self.assertEqual(error["message"], "rank 1 holds another model or other volumes than rank 0")
        self.assertNotIn("a", [volume["name"] for volume in self.footwall("info", project)["volumes"]])

        def another():
            done = self.start("status", "@e.json", "--json")
            return done.returncode == 0 and json.loads(done.stdout)["process"] != first["process"]
        self.until(another, "it is not started again")
        second = self.footwall("status", "@e.json")
        for name in ("faces", "volumes", "state_hash"):
            self.assertEqual(second[name], first[name], name)
        self.assertEqual(self.footwall("extract", project, "--engine", "@e.json")["checksum"], wanted)
        family += below(process.pid)
        self.footwall("stop", "@e.json")
        words = self.ended(process)
        self.assertIn("rank 1 holds another model", words)
        self.assertEqual(words.count("it is started again"), 1, words)
        self.assert_nothing_is_left(family)


if __name__ == "__main__":
    unittest.main()

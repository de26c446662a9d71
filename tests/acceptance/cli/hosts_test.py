"""Jobs whose ranks are on two hosts."""
import json
import os
import shutil
import signal
import subprocess
import time
import unittest

import hosts
from hosts import HERE, THERE
from processes import go_on, is_rank, stopped_ranks
from support import BIN, FootwallTest


def setUpModule():
    hosts.make_hosts()


class Hosts(FootwallTest):
    def setUp(self):
        super().setUp()
        self.two_hosts = hosts.launcher(self.folder)

    def test_a_batch_job_gives_the_numbers_of_one_host(self):
        project = self.synthetic()
        one = self.footwall("extract", project, "--ranks", 1)
        self.footwall("extract", project, "--write-job", "job")
        for ranks in (2, 3):
            shutil.rmtree(self.path("job/parts"), ignore_errors=True)
            done = self.footwall("batch", "job/JOB.json", "--ranks", ranks, env=self.two_hosts)
            self.assertEqual(done["checksum"], one["checksum"])
            result = json.loads((self.folder / "job/parts/result.json").read_text())
            self.assertEqual({each["host"] for each in result["each_rank"]}, {HERE, THERE})
        self.assertEqual(self.footwall("attach", project, "job")["checksum"], one["checksum"])

    def test_surfaces_and_pictures_are_those_of_one_host(self):
        project = self.synthetic()
        for name, env in (("one", None), ("two", self.two_hosts)):
            self.footwall("isosurface", project, "--value", "0.2", "--out", f"{name}.h5", "--ranks", 2, env=env)
            self.footwall("render", project, "--isosurface", "amplitude=0.2", "--size", "200x150", "--out", f"{name}.png",
                          "--ranks", 2, env=env)
        for kind in ("h5", "png"):
            self.assertEqual((self.folder / f"one.{kind}").read_bytes(), (self.folder / f"two.{kind}").read_bytes(), kind)

    def test_an_error_over_there_is_told_here_and_ends_all(self):
        project = self.synthetic()
        self.footwall("extract", project, "--write-job", "job")
        done = self.start("batch", "job/JOB.json", "--ranks", 2, "--volume", "nowhere.h5", "--json", env=self.two_hosts)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(json.loads(done.stdout)["error"]["code"], "not_found")

    def test_the_word_to_make_room_reaches_both_hosts(self):
        project = self.synthetic(size="200x200x200")
        self.footwall("extract", project, "--write-job", "job")
        program = subprocess.Popen([str(BIN / "footwall"), "batch", "job/JOB.json", "--ranks", "2", "--json"], text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=self.folder,
                                   env={**os.environ, **self.two_hosts})
        ranks = stopped_ranks(program, 2)
        self.assertIsNone(program.poll(), "it ended before it could be told")
        program.send_signal(signal.SIGUSR1)
        go_on(ranks)
        told = time.monotonic()
        answer, words = program.communicate(timeout=120)
        self.assertEqual(program.returncode, 75, answer + words)
        self.assertLess(time.monotonic() - told, 20)
        for rank in ranks:
            self.assertFalse(is_rank(rank), "a rank outlived the program")


if __name__ == "__main__":
    unittest.main()

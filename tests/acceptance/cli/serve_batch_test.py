"""footwall batch --engine: the same results as without, and a job that was stopped goes on, here or there."""
import json
import os
import pathlib
import shutil
import signal
import unittest

from served import ServedTest


class ServeBatch(ServedTest):
    def setUp(self):
        super().setUp()
        self.parts = self.folder / "job" / "parts"

    def job(self, *options):
        project = self.synthetic(size="96x96x96")
        self.footwall("triangulate", project, *options)
        self.footwall("extract", project, "--write-job", "job", "--ranks", 2)
        self.engine = self.serve(project, "--connection", "e.json", wait_for="@e.json")
        return project

    def batch(self, *how):
        return self.footwall("batch", "job/JOB.json", *how)

    def reused(self, answer):
        return [part["reused"] for part in answer["parts"]]

    def stop_engine(self):
        self.footwall("stop", "@e.json")
        self.ended(self.engine)

    def test_its_results_are_those_of_a_run_of_its_own(self):
        project = self.job()
        running = ("--engine", "@e.json")
        there = self.batch(*running)
        self.assertEqual(self.reused(there), [False] * len(there["parts"]))
        self.assertEqual(sorted(os.listdir(self.parts)),
                         sorted([*(part["file"] for part in there["parts"]), "log.txt", "result.json"]))
        self.assertEqual(self.footwall("attach", project, "job", "--name", "there")["checksum"], there["checksum"])

        # What one made the other goes on with, and the log tells of both.
        here = self.batch("--ranks", 2)
        self.assertEqual(self.reused(here), [True] * len(there["parts"]))
        again = self.batch(*running)
        self.assertEqual(self.reused(again), [True] * len(there["parts"]))
        log = (self.parts / "log.txt").read_text().splitlines()
        self.assertEqual([line.split()[-1] for line in log if not line.startswith(" ")], ["done"] * 3)

        shutil.rmtree(self.parts)
        own = self.batch("--ranks", 2)
        for answer in (here, again, own):
            for key in ("checksum", "faces", "voxels"):
                self.assertEqual(answer[key], there[key], key)
        attached = self.footwall("info", project)["runs"][-1]["run"]
        runs = [attached, self.footwall("extract", project, "--ranks", 2)["run"]]
        for run in runs:
            self.footwall("faces", project, "--run", run, "--csv", f"{run}.csv")
        self.assertEqual(*[pathlib.Path(self.path(f"{run}.csv")).read_text() for run in runs])
        self.stop_engine()
        self.assertEqual(os.listdir(self.temporary), [])

    def test_parts_that_are_there_are_not_computed_again(self):
        self.job()
        whole = self.batch("--engine", "@e.json")
        gone, damaged = whole["parts"][1], whole["parts"][2]
        os.remove(self.parts / gone["file"])
        (self.parts / damaged["file"]).write_bytes(b"no part")
        os.remove(self.parts / "result.json")
        again = self.batch("--engine", "@e.json")
        self.assertEqual(self.reused(again), [part not in (gone, damaged) for part in whole["parts"]])
        self.assertEqual(again["checksum"], whole["checksum"])
        self.assertEqual(self.reused(self.batch("--ranks", 1)), [True] * len(whole["parts"]))
        self.stop_engine()

    def test_a_stopped_job_keeps_its_parts_and_goes_on(self):
        self.job("--max-edge", "0.8")  # more faces than one group has
        for number, status in ((signal.SIGINT, 130), (signal.SIGUSR1, 75)):
            with self.subTest(signal=number.name):
                shutil.rmtree(self.parts, ignore_errors=True)
                program = self.popen("batch", "job/JOB.json", "--engine", "@e.json", "--json")
                self.until(lambda: program.poll() is not None or list(self.parts.glob("fault-*.part.h5")), "no part arrives")
                program.send_signal(number)
                answer, words = program.communicate()
                self.assertEqual(program.returncode, status, answer + words)
                kept = {path.name for path in self.parts.iterdir()}
                self.assertTrue(all(name.endswith(".part.h5") and name.startswith("fault-") for name in kept), kept)
                done = self.batch("--engine", "@e.json")
                self.assertEqual({part["file"] for part in done["parts"] if part["reused"]}, kept)
                self.assertLess(len(kept), len(done["parts"]))
        shutil.rmtree(self.parts)
        self.assertEqual(self.batch("--ranks", 2)["checksum"], done["checksum"])
        # The engine works on.
        self.assertEqual(json.loads(self.start("status", "@e.json", "--json").stdout)["jobs"], [])
        self.stop_engine()


if __name__ == "__main__":
    unittest.main()

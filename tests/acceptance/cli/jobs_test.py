"""Jobs for clusters: written here, run elsewhere, brought back; forecasts; what happens when a run is stopped or killed."""
import json
import os
import pathlib
import shutil
import signal
import stat
import subprocess
import time
import unittest

from processes import HeldRuns, go_on, stopped_ranks
from support import BIN, SOURCE

MPIRUN = ["mpirun", "--bind-to", "none", "--oversubscribe", "-n"]
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


class Jobs(HeldRuns):
    def engine(self, ranks, *arguments, env=None, folder=None):
        return subprocess.run([*MPIRUN, str(ranks), str(BIN / "footwall-engine"), *map(str, arguments)], capture_output=True,
                              text=True, cwd=folder or self.folder, timeout=300, env={**os.environ, **AS_ROOT, **(env or {})})

    def script(self, name, text):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text("#!/bin/bash\n" + text)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return path

    def move_a_node(self, project, fault):
        (found,) = [each for each in self.footwall("faults", project)["faults"] if each["name"] == fault]
        node = found["pillars"][0]["nodes"][0]
        line = {"op": "move", "what": "node", "node": node["node"], "x": node["x"] + 60, "y": node["y"], "z": node["z"]}
        self.assertEqual(self.start("edit", project, stdin=json.dumps(line)).returncode, 0)

    def test_a_job_runs_in_a_copy_of_its_folder_and_comes_back(self):
        project = self.synthetic()
        written = self.footwall("extract", project, "--write-job", "job", "--with-volume", "--ranks", 3, "--name", "far away")
        self.assertTrue(written["with_volume"])
        self.assertEqual(sorted(os.listdir(self.folder / "job")),
                         ["JOB.faces", "JOB.json", "README.txt", "job.sbatch", "volume.h5"])
        direct = self.footwall("extract", project, "--ranks", 1)

        shutil.copytree(self.folder / "job", self.folder / "other place" / "copy")
        shutil.rmtree(self.folder / "job")
        shutil.move(self.folder / f"{project}.volumes", self.folder / "hidden")  # the copy needs nothing of the project
        done = self.engine(2, "batch", "JOB.json", folder=self.folder / "other place" / "copy")
        self.assertEqual(done.returncode, 0, done.stderr)
        shutil.move(self.folder / "hidden", self.folder / f"{project}.volumes")

        attached = self.footwall("attach", project, "other place/copy")
        for key in ("checksum", "faces", "voxels"):
            self.assertEqual(attached[key], direct[key], key)
        self.assertEqual((attached["ranks"], attached["stale"], attached["missing"]), (2, [], []))
        self.assertEqual([run["name"] for run in self.footwall("info", project)["runs"]][-1], "far away")
        for run, name in ((direct["run"], "a.csv"), (attached["run"], "b.csv")):
            self.footwall("faces", project, "--run", run, "--csv", name)
        self.assertEqual(*[pathlib.Path(self.path(name)).read_text() for name in ("a.csv", "b.csv")])

        error = self.refused(1, "attach", project, "other place/copy")
        self.assertIn(f"as run {attached['run']}", error["message"])

    def test_the_volume_may_be_elsewhere_and_must_be_the_same(self):
        project = self.synthetic()
        self.footwall("extract", project, "--write-job", "job")
        wanted = self.footwall("extract", project, "--ranks", 2)["checksum"]
        os.rename(self.path(f"{project}.volumes/amplitude.h5"), self.path("moved.h5"))
        self.assertEqual(self.refused(1, "batch", "job/JOB.json", "--ranks", 1)["code"], "not_found")
        self.assertEqual(self.footwall("batch", "job/JOB.json", "--ranks", 2, "--volume", "moved.h5")["checksum"], wanted)
        self.synthetic("other.footwall", seed=9)
        error = self.refused(1, "batch", "job/JOB.json", "--volume", "other.footwall.volumes/amplitude.h5")
        self.assertIn("checksum", error["message"])

    def test_what_was_edited_since_is_stale(self):
        project = self.synthetic()
        self.footwall("extract", project, "--write-job", "job", "--ranks", 1)
        self.footwall("batch", "job/JOB.json", "--ranks", 1)
        self.move_a_node(project, "listric")
        self.footwall("triangulate", project)
        attached = self.footwall("attach", project, "job/JOB.json")
        (stale,) = attached["stale"]
        self.assertEqual(stale["fault"], "listric")
        self.assertTrue(0 < stale["stale"] < stale["faces"], stale)

    def test_results_of_other_things_are_refused(self):
        project = self.synthetic()
        self.footwall("extract", project, "--write-job", "job", "--ranks", 1)
        self.assertIn("not computed", self.refused(1, "attach", project, "job")["message"])
        self.assertEqual(self.refused(1, "attach", project, "nowhere")["code"], "not_found")
        self.footwall("batch", "job/JOB.json", "--ranks", 1)
        other = self.synthetic("other.footwall", seed=9)
        self.assertIn("checksum", self.refused(1, "attach", other, "job")["message"])
        runs = self.footwall("info", project)["runs"]
        line = json.dumps({"op": "delete", "what": "fault", "fault": "listric"})
        self.assertEqual(self.start("edit", project, stdin=line).returncode, 0)
        self.assertIn("listric", self.refused(1, "attach", project, "job")["message"])
        self.footwall("undo", project)
        (part, *_) = sorted((self.folder / "job" / "parts").glob("*.part.h5"))
        whole = part.read_bytes()
        damaged = bytearray(whole)
        for place in range(len(damaged) // 3, 2 * len(damaged) // 3):  # one byte alone may be one that means nothing
            damaged[place] ^= 1
        part.write_bytes(damaged)
        self.assertIn(self.refused(1, "attach", project, "job")["code"], ("corrupt", "format"))
        part.write_bytes(whole)
        self.assertEqual(self.footwall("info", project)["runs"], runs)  # nothing half attached
        self.assertIn("something in", self.refused(1, "extract", project, "--write-job", "job")["message"])

    def test_parts_that_are_there_attach_when_asked_for(self):
        project = self.synthetic()
        self.footwall("extract", project, "--write-job", "job", "--ranks", 1)
        whole = self.footwall("batch", "job/JOB.json", "--ranks", 1)
        gone = whole["parts"][1]
        os.remove(self.path(f"job/parts/{gone['file']}"))
        os.remove(self.path("job/parts/result.json"))
        error = self.refused(1, "attach", project, "job")
        self.assertIn(gone["name"], error["message"])
        self.assertIn("--partial", error["hint"])
        partly = self.footwall("attach", project, "job", "--partial")
        self.assertEqual((partly["missing"], partly["faces"]), ([gone["name"]], whole["faces"] - gone["faces"]))
        self.assertIsNone(partly["seconds"])
        again = self.footwall("batch", "job/JOB.json", "--ranks", 2)
        self.assertEqual([part["reused"] for part in again["parts"]], [part != gone for part in whole["parts"]])
        self.assertEqual(self.footwall("attach", project, "job")["checksum"], whole["checksum"])

    def test_a_dry_run_tells_and_changes_nothing(self):
        project = self.synthetic(size="160x160x160")
        before = pathlib.Path(self.path(project)).read_bytes()
        told = self.footwall("extract", project, "--dry-run", "--ranks", 2)
        self.assertEqual(pathlib.Path(self.path(project)).read_bytes(), before)
        self.assertIn("listric", told["triangulated"])  # it would be
        done = self.footwall("extract", project, "--ranks", 2)
        self.assertEqual((told["voxels_counted"], told["voxels"], told["faces"], told["ranks"]),
                         ("exactly", done["voxels"], done["faces"], 2))
        self.assertGreaterEqual(told["bytes_to_read"], 4 * 160**3)
        self.assertGreater(told["memory_per_rank"]["total"], 4 * 160**3 / 2)
        self.assertEqual(told["command"][-3:-1], [str(BIN / "footwall-engine"), "batch"])
        self.assertGreater(told["seconds"]["total"], 0)
        self.refused(2, "extract", project, "--dry-run", "--write-job", "x")
        self.refused(2, "extract", project, "--with-volume")

    def test_tasks_that_do_not_know_of_each_other_are_refused(self):
        project = self.synthetic()
        self.footwall("extract", project, "--write-job", "job")
        for name in ("SLURM_NTASKS", "SLURM_STEP_NUM_TASKS", "PMI_SIZE"):
            done = subprocess.run([str(BIN / "footwall-engine"), "batch", "job/JOB.json"], capture_output=True, text=True,
                                  cwd=self.folder, env={**os.environ, name: "4"})
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("MPI sees only this one", done.stderr)
        self.assertFalse((self.folder / "job" / "parts").exists())
        # One rank on purpose, in an allocation of four.
        self.assertEqual(self.engine(1, "batch", "job/JOB.json", env={"SLURM_NTASKS": "4"}).returncode, 0)

    def test_inside_an_allocation_srun_starts_as_many_ranks_as_were_granted(self):
        project = self.synthetic()
        self.script("bin/srun", f"""
if [ "$1" = --mpi=list ]; then printf 'MPI plugin types are...\\n\\tnone\\n\\tpmi2\\n'; [ -n "$PMIX" ] && printf '\\tpmix\\n'; exit; fi
echo "$@" > {self.folder}/words
while [ "${{1#--}}" != "$1" ]; do shift; done
exec mpirun --bind-to none --oversubscribe -n 3 "$@"
""")
        slurm = {"PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}", "SLURM_JOB_ID": "7", "SLURM_NTASKS": "3",
                 "SLURM_CPUS_PER_TASK": "2", **AS_ROOT}
        done = self.footwall("extract", project, env={**slurm, "PMIX": "1"})
        self.assertEqual((done["ranks"], done["threads"]), (3, 2))
        words = (self.folder / "words").read_text().split()
        self.assertEqual(words[:3], ["--mpi=pmix", "--ntasks=3", "--cpus-per-task=2"])
        told = self.footwall("extract", project, "--dry-run", env=slurm)
        self.assertEqual((told["command"][:2], told["ranks"], told["threads"]), (["srun", "--mpi=pmi2"], 3, 2))
        # The script takes the same way.
        self.footwall("extract", project, "--write-job", "job", "--ranks", 3)
        self.assertEqual(subprocess.run(["bash", "-n", self.path("job/job.sbatch")]).returncode, 0)
        done = subprocess.run(["bash", "job.sbatch"], cwd=self.folder / "job", capture_output=True, text=True,
                              env={**os.environ, **slurm, "PMIX": "1", "FOOTWALL_ENGINE": str(BIN / "footwall-engine")})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "words").read_text().split()[0], "--mpi=pmix")
        self.assertEqual(self.footwall("attach", project, "job")["ranks"], 3)
        started = self.start("extract", project, env={**slurm, "SLURM_STEP_ID": "0", "SLURM_STEP_NUM_TASKS": "3"})
        self.assertEqual(started.returncode, 1)
        self.assertIn("started 3 times", started.stderr)

    def test_the_script_for_projects_on_shared_disks_attaches_what_it_made(self):
        project = self.synthetic()
        script = SOURCE / "packaging" / "slurm" / "extract.sbatch"
        done = subprocess.run(["bash", str(script), project], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, **AS_ROOT, "PATH": f"{BIN}:{os.environ['PATH']}"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(self.footwall("info", project)["runs"]), 1)

    def test_nothing_outlives_a_killed_program(self):
        project = self.synthetic(size="200x200x200")
        program, below, _ = self.held(2, "extract", project)
        program.kill()
        program.communicate()
        self.assert_gone(below)
        # What it left on disk is swept by the next run.
        done = self.start("extract", project, "--ranks", 1, env={"TMPDIR": self.path("tmp")})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(os.listdir(self.folder / "tmp"), [])

    def test_ctrl_c_leaves_nothing_behind(self):
        project = self.synthetic(size="200x200x200")
        before = self.footwall("info", project)["runs"]
        program, below, ranks = self.held(2, "extract", project)
        program.send_signal(signal.SIGINT)
        go_on(ranks)
        _, words = program.communicate(timeout=120)
        self.assertEqual(program.returncode, 130, words)
        self.assert_gone(below)
        self.assertEqual(os.listdir(self.folder / "tmp"), [])
        self.assertEqual(self.footwall("info", project)["runs"], before)

    def test_a_job_that_must_make_room_says_that_it_can_go_on(self):
        project = self.synthetic(size="200x200x200")
        self.footwall("extract", project, "--write-job", "job", "--ranks", 2)
        for number, whom in ((signal.SIGTERM, "rank"), (signal.SIGUSR1, "rank"), (signal.SIGUSR1, "footwall")):
            with self.subTest(signal=number.name, sent_to=whom):
                program, below, ranks = self.held(2, "batch", "job/JOB.json", "--json")
                os.kill(ranks[0] if whom == "rank" else program.pid, number)  # as Slurm does it, to tasks or to the script
                go_on(ranks)
                told = time.monotonic()
                answer, words = program.communicate(timeout=120)
                self.assertLess(time.monotonic() - told, 20, "Slurm would have killed it")
                self.assertEqual(program.returncode, 75, answer + words)
                self.assertIn("goes on", json.loads(answer)["error"]["hint"])
                self.assert_gone(below)
        done = self.footwall("batch", "job/JOB.json", "--ranks", 2)
        self.assertEqual(done["checksum"], self.footwall("extract", project, "--ranks", 1)["checksum"])

    def test_the_log_tells_what_each_rank_did(self):
        project = self.synthetic()
        self.footwall("extract", project, "--write-job", "job", "--ranks", 2)
        for _ in range(2):
            self.footwall("batch", "job/JOB.json", "--ranks", 2)
        result = json.loads((self.folder / "job/parts/result.json").read_text())
        self.assertEqual([each["rank"] for each in result["each_rank"]], [0, 1])
        for each in result["each_rank"]:
            self.assertEqual(each["host"], os.uname().nodename)
            self.assertGreater(each["peak_memory_bytes"], 1 << 20)
            self.assertLessEqual(each["seconds"]["voxelize"], each["seconds"]["total"])
        log = (self.folder / "job/parts/log.txt").read_text().splitlines()
        self.assertEqual([line.split()[-1] for line in log if not line.startswith(" ")], ["done", "done"])
        self.assertEqual(sum(line.startswith("  rank ") for line in log), 4)

    def test_the_script_for_slurm_passes_its_signal_on_and_comes_back(self):
        project = self.synthetic(size="200x200x200")
        self.footwall("extract", project, "--write-job", "job", "--ranks", 2)
        self.script("bin/srun", """
if [ "$1" = --mpi=list ]; then printf 'MPI plugin types are...\\n\\tpmix\\n'; exit; fi
while [ "${1#--}" != "$1" ]; do shift; done
exec mpirun --bind-to none --oversubscribe -n 2 "$@"
""")
        self.script("bin/scontrol", f'echo "$@" > {self.folder}/requeued')
        script = subprocess.Popen(["bash", "job.sbatch"], cwd=self.folder / "job", text=True, stderr=subprocess.PIPE, env={
            **os.environ, **AS_ROOT, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}", "SLURM_JOB_ID": "7",
            "SLURM_NTASKS": "2", "FOOTWALL_ENGINE": str(BIN / "footwall-engine")})
        ranks = stopped_ranks(script, 2)
        self.assertIsNone(script.poll(), "it ended before it could be told")
        script.send_signal(signal.SIGUSR1)
        go_on(ranks)
        _, words = script.communicate(timeout=120)
        self.assertEqual(script.returncode, 75, words)
        self.assertEqual((self.folder / "requeued").read_text(), "requeue 7\n")
        self.assert_gone(ranks)


if __name__ == "__main__":
    unittest.main()

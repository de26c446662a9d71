"""The resident engine with ranks on two hosts, and on a host that has nothing of the project but its volume."""
import hashlib
import json
import os
import pathlib
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import hosts
from hosts import HERE, THERE, on_host, running_on
from served import PATIENCE, ServedTest, is_gone
from support import BIN, FootwallTest

PACKAGE = BIN.parent / "python"
sys.path.insert(0, str(PACKAGE))
os.environ["FOOTWALL_PROGRAM"] = str(BIN / "footwall")

import footwall  # noqa: E402
import numpy  # noqa: E402


def setUpModule():
    hosts.make_hosts()


def tell(what):
    """A measurement: the machine may be busy with something else, so nothing hangs on it."""
    print(f"    {what}", file=sys.stderr, flush=True)


def digest(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


def processor_seconds(process):
    return sum(int(path.read_text().split()[0]) for path in pathlib.Path(f"/proc/{process}/task").glob("*/schedstat")) * 1e-9


class Job:
    """An extraction of a resident engine, on a thread of its own."""

    def __init__(self, engine, **how):
        self.engine = engine
        self.error = None
        self.fraction = 0.0
        self.over = False
        self._thread = threading.Thread(target=self._run, kwargs=how)
        self._thread.start()

    def _run(self, **how):
        try:
            self.engine.extract(progress=self._heard, **how)
        except footwall.Error as error:
            self.error = error
        self.over = True

    def _heard(self, fraction, *_):
        self.fraction = fraction

    def begun(self):
        """Whether all ranks compute; or it is over."""
        return self.fraction > 0.05 or self.over

    def cancel(self):
        self.engine.cancel(self.engine.status().jobs[0].job)

    def wait(self):
        self._thread.join(PATIENCE)
        return not self._thread.is_alive()


class ResidentOnTwoHosts(ServedTest):
    def setUp(self):
        super().setUp()
        self.env.update(hosts.launcher(self.folder))

    def served(self, project, ranks=2):
        """A Python client of an engine with ranks on both hosts; also its process and what is known of its ranks."""
        process = self.serve(project, "--connection", "e.json", wait_for="@e.json", ranks=ranks)
        engine = footwall.Engine.connect(f"@{self.path('e.json')}", footwall.open(self.path(project)))
        self.addCleanup(engine.close)
        each_rank = list(engine.status().each_rank)
        self.assertEqual({rank.host for rank in each_rank}, {HERE, THERE})
        for rank in each_rank:
            if rank.host == THERE:
                # What its start needed there is gone, so that nothing can stay, whatever happens.
                left = os.listdir(f"/proc/{rank.process}/root/dev/shm")
                self.assertEqual([name for name in left if name.startswith("footwall-")], [])
        return process, engine, each_rank

    def with_much_to_do(self):
        project = self.synthetic(size="160x160x160")
        self.footwall("triangulate", project, "--max-edge", 2)
        return project

    def end(self, process):
        self.footwall("stop", "@e.json")
        self.ended(process)
        self.assert_hosts_are_empty()

    def assert_hosts_are_empty(self):
        for host in (HERE, THERE):
            for left in running_on(host):
                self.assertTrue(is_gone(left), f"process {left} is left on {host}")

    def test_numbers_pictures_and_edits_are_those_of_one_host(self):
        project = self.synthetic()
        own = self.footwall("extract", project, "--ranks", 1)
        for ranks in (2, 3):
            process, engine, each_rank = self.served(project, ranks)
            one, two = [self.footwall("extract", project, *how) for how in ((), ("--engine", "@e.json"))]
            self.assertEqual({own["checksum"], one["checksum"], two["checksum"]}, {own["checksum"]})
            pictures = []
            for how, name in (((), "own"), (("--engine", "@e.json"), "engine")):
                self.footwall("render", project, "--isosurface", "amplitude=0.2", "--size", "200x150", "--out", f"{name}.png", *how)
                pictures.append(digest(self.path(f"{name}.png")))
            self.assertEqual(*pictures)
            self.drag(engine)
            self.measure_idleness(each_rank)
            self.end(process)

    def drag(self, engine):
        """As a hand moves a vertex; then the numbers are those of a whole extraction."""
        fault = str(engine.project.faults()["name"][0])
        seconds, in_engine = [], []
        with engine.live() as live:
            mesh = live.mesh(fault)
            vertex = int(mesh.triangles[len(mesh.triangles) // 2, 0])
            before = mesh.vertices[vertex].copy()
            for step in range(200):
                begun = time.monotonic()
                answer = live.wait(live.move(fault, vertex, before + [0.02 * step, 0, 0]))
                seconds.append(time.monotonic() - begun)
                in_engine.append(answer.engine_seconds)
        for what, times in (("a vertex moved, until its numbers are here", seconds), ("of this, in the engine", in_engine)):
            tell(f"{what}: median {statistics.median(times) * 1e3:.2f} ms, 99 of 100 within {sorted(times)[-3] * 1e3:.2f} ms")
        whole = engine.extract()
        row = {name: n for n, name in enumerate(zip(whole.faults.tolist(), whole.ids.tolist()))}
        order = [row[name] for name in zip(answer.faults.tolist(), answer.ids.tolist())]
        self.assertGreater(len(order), 1)
        for name in ("count", "mean", "variance", "contrast"):
            numpy.testing.assert_array_equal(answer[name], whole[name][order], name)

    def measure_idleness(self, each_rank):
        before = [processor_seconds(rank.process) for rank in each_rank]
        time.sleep(2)  # what is measured is a time
        for rank, used in zip(each_rank, before):
            tell(f"rank {rank.rank} on {rank.host}, idle: {(processor_seconds(rank.process) - used) * 50:.3f} % of a core")

    def test_a_cancel_reaches_the_other_host_at_once(self):
        project = self.with_much_to_do()
        process, engine, each_rank = self.served(project)
        there = next(rank.process for rank in each_rank if rank.host == THERE)
        many = {"compute": ["mean", "contrast", "offset"]}
        before = engine.status().state_hash
        # 1 All ranks compute.
        job = Job(engine, **many)
        self.until(job.begun, "it does not begin")
        self.assertFalse(job.over, "it was done at once")
        begun = time.monotonic()
        job.cancel()
        self.assertTrue(job.wait(), "it was cancelled and goes on")
        tell(f"cancelled while all compute: {(time.monotonic() - begun) * 1e3:.0f} ms")
        self.assertIsNotNone(job.error, "it was done before it was cancelled")
        self.assertEqual(job.error.code, "cancelled")
        # 2 Rank 0 waits in MPI for the other host.
        job = Job(engine, **many)
        self.until(job.begun, "it does not begin")
        self.assertFalse(job.over, "it was done at once")
        os.kill(there, signal.SIGSTOP)
        heard = [-1.0]

        def waits():
            heard.append(job.fraction)
            time.sleep(0.2)  # a rank that computes tells how far it is in less
            return heard[-1] == job.fraction
        self.until(waits, "rank 0 does not wait for the other")
        job.cancel()
        os.kill(there, signal.SIGCONT)
        begun = time.monotonic()
        self.assertTrue(job.wait(), "it was cancelled and goes on")
        tell(f"cancelled while rank 0 waits for the other host: {(time.monotonic() - begun) * 1e3:.0f} ms")
        self.assertIsNotNone(job.error, "nobody there heard of it")
        self.assertEqual(job.error.code, "cancelled")
        # Both work on, on the state of before.
        self.until(lambda: not engine.status().jobs, "the job stays")
        self.assertEqual(engine.status().state_hash, before)
        own = self.footwall("extract", project)
        self.assertEqual(self.footwall("extract", project, "--engine", "@e.json")["checksum"], own["checksum"])
        self.end(process)

    def test_a_rank_that_is_killed_over_there_is_told_and_leaves_nothing(self):
        project = self.with_much_to_do()
        process, engine, each_rank = self.served(project)
        own = self.footwall("extract", project)
        there = next(rank.process for rank in each_rank if rank.host == THERE)
        first = running_on(HERE) + running_on(THERE)
        job = Job(engine, compute=["mean", "contrast", "offset"])
        self.until(job.begun, "it does not begin")
        self.assertFalse(job.over, "it was done at once")
        os.kill(there, signal.SIGKILL)
        begun = time.monotonic()
        self.assertTrue(job.wait(), "the call does not end")
        tell(f"a killed rank, until the call fails: {(time.monotonic() - begun) * 1e3:.0f} ms")
        self.assertIsNotNone(job.error, "it was done before the rank was killed")
        self.assertEqual(job.error.code, "engine", job.error)
        for each in first:
            self.assertTrue(is_gone(each), f"process {each} is left")
        # Started again, as on one host.
        self.assertTrue(self.answers(process, "@e.json"))
        again = self.footwall("status", "@e.json")
        self.assertEqual({rank["host"] for rank in again["each_rank"]}, {HERE, THERE})
        self.assertEqual(self.footwall("extract", project, "--engine", "@e.json")["checksum"], own["checksum"])
        self.end(process)


class EngineElsewhere(FootwallTest):
    """The engine's host sees nothing of the client's folder, nor the client of the engine's."""

    def setUp(self):
        super().setUp()
        self.there = pathlib.Path(tempfile.mkdtemp(prefix="footwall-there-"))
        self.addCleanup(shutil.rmtree, self.there, ignore_errors=True)
        self.desk = on_host(HERE, hidden=("/dev/shm", self.there))
        self.cluster = on_host(THERE, hidden=("/dev/shm", self.folder))

    def environment(self, folder):
        made = folder / "tmp"
        made.mkdir(exist_ok=True)
        return {**os.environ, **hosts.AS_ROOT, "HOME": str(folder), "TMPDIR": str(made), "XDG_RUNTIME_DIR": "",
                "FOOTWALL_PROGRAM": str(BIN / "footwall"), "PYTHONPATH": str(PACKAGE)}

    def start(self, *arguments, stdin=None, env=None):
        return self.at_the_desk(str(BIN / "footwall"), *map(str, arguments))

    def at_the_desk(self, *words):
        return subprocess.run([*self.desk, *words], capture_output=True, text=True, cwd=self.folder, timeout=300,
                              env=self.environment(self.folder))

    def serving(self):
        """An engine over there, and its connection file over here, as by scp."""
        process = subprocess.Popen(
            [*self.cluster, str(BIN / "footwall"), "serve", "--ranks", "2", "--volumes", "volumes", "--listen",
             f"tcp:{hosts.NETWORK}.2:0", "--connection", "engine.json"], cwd=self.there, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=self.environment(self.there))
        self.addCleanup(process.communicate)
        self.addCleanup(lambda: process.poll() is None and process.kill())
        end = time.monotonic() + PATIENCE
        while not (self.there / "engine.json").exists():
            self.assertIsNone(process.poll(), "no engine")
            self.assertLess(time.monotonic(), end, "no engine")
            time.sleep(0.05)
        shutil.copy2(self.there / "engine.json", self.folder / "engine.json")
        self.footwall("status", "@engine.json", "--wait", PATIENCE)
        return process

    def test_the_project_stays_at_the_desk(self):
        project = self.synthetic()
        own = self.footwall("extract", project, "--ranks", 2)
        made = []
        for name, how in (("own", ("--ranks", 2)), ("engine", ("--engine", "@engine.json"))):
            if name == "engine":
                # A volume is known by its checksum, whatever its name.
                (self.there / "volumes").mkdir()
                for n, file in enumerate((self.folder / f"{project}.volumes").glob("*.h5")):
                    shutil.copy(file, self.there / "volumes" / f"v{n}.h5")
                process = self.serving()
                unseen = subprocess.run([*self.cluster, "ls", self.folder / project], capture_output=True)
                self.assertNotEqual(unseen.returncode, 0, "the engine's host sees the project")
                self.assertEqual(self.footwall("status", "@engine.json")["host"], THERE)
                self.assertEqual(self.footwall("extract", project, *how)["checksum"], own["checksum"])
            self.footwall("isosurface", project, "--value", "0.5", "--out", f"{name}.vtp", *how)
            self.footwall("render", project, "--isosurface", "amplitude=0.5", "--size", "200x150", "--out", f"{name}.png", *how)
            made.append([digest(self.path(f"{name}.{kind}")) for kind in ("vtp", "png")])
        self.assertEqual(*made)
        # A script sends the model and gets numbers.
        done = self.at_the_desk(sys.executable, "-B", "-c", f"""
import json, footwall
engine = footwall.Engine.connect("@engine.json", footwall.open({project!r}))
engine.open_volume()
engine.load_model()
numbers = engine.extract()
print(json.dumps([sorted(numbers["count"].tolist()), sorted(numbers["variance"].tolist())]))
""")
        self.assertEqual(done.returncode, 0, done.stderr)
        told = footwall.open(self.path(project)).statistics().values
        self.assertEqual(json.loads(done.stdout), [sorted(told[name].tolist()) for name in ("count", "variance")])
        self.footwall("stop", "@engine.json")
        out, err = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 0, out + err)
        self.assertEqual(os.listdir(self.there / "tmp"), [])
        for left in running_on(THERE):
            self.assertTrue(is_gone(left), f"process {left} is left")

    def test_a_volume_that_is_not_there_is_named(self):
        project = self.synthetic()
        checksum = self.footwall("info", project)["volumes"][0]["checksum"]
        (self.there / "volumes").mkdir()
        process = self.serving()
        error = self.refused(1, "extract", project, "--engine", "@engine.json")
        self.assertEqual(error["code"], "not_found")
        self.assertIn(checksum, error["message"])
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=PATIENCE)
        for left in running_on(THERE):
            self.assertTrue(is_gone(left), f"process {left} is left")


if __name__ == "__main__":
    unittest.main()

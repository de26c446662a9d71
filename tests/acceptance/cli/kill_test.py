"""Whatever process is killed, at whatever moment of a mixed load, and whatever two: no edit is lost, nothing hangs, no
process, socket, file or shared memory stays, and the next call works. FOOTWALL_KILLS: how often (default 8)."""
import json
import os
import pathlib
import queue
import random
import signal
import subprocess
import sys
import threading
import time
import unittest

from served import PATIENCE, ServedTest, below, is_gone, name_of

KILLS = int(os.environ.get("FOOTWALL_KILLS", "8"))
SEED = int(os.environ.get("FOOTWALL_KILL_SEED", "7"))
ENGINE = ("rank", "rank 0", "launcher", "keeper", "serve")
CLIENTS = ("command", "mover", "caller")
KINDS = ENGINE + CLIENTS


class Client:
    """A process of kill_clients.py."""

    def __init__(self, test, kind):
        self.kind = kind
        self.process = subprocess.Popen(
            [sys.executable, "-B", str(pathlib.Path(__file__).with_name("kill_clients.py")), kind,
             str(test.folder / "e.json"), str(test.folder / test.project)],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd=test.folder, env={**os.environ, **test.env})
        self.lines = queue.Queue()
        threading.Thread(target=self.listen, daemon=True).start()
        self.begun = False

    def listen(self):
        for line in self.process.stdout:
            self.lines.put(line.strip())
        self.lines.put("")

    def alive(self):
        return self.process.poll() is None

    def say(self, seconds=PATIENCE):
        """Its next line; "" where it has ended."""
        return self.lines.get(timeout=seconds)

    def wait_until_begun(self):
        if not self.begun:
            assert self.say() == "begun", self.kind
            self.begun = True

    def checked(self):
        self.process.stdin.write("check\n")
        self.process.stdin.flush()
        return self.say()

    def end(self):
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()


class Kill(ServedTest):
    def setUp(self):
        super().setUp()
        self.project = self.synthetic()
        self.expected = self.footwall("extract", self.project, "--ranks", "1")["checksum"]
        self.footwall("extract", self.project, "--write-job", "job")
        self.names = {fault["name"] for fault in self.footwall("faults", self.project)["faults"]}
        self.edits = self.names
        self.command = None
        self.over = threading.Event()
        self.problems = []
        self.clients = {}
        self.addCleanup(lambda: [client.end() for client in self.clients.values()])

    def again(self):
        """The serve process, started where there is none, once it answers, and its status."""
        # It gives up where it was killed too often, which is right, and a second one has to be started.
        while not (self.serving and self.answers(self.serving[-1], "@e.json")):
            with open(self.path("serve.log"), "a") as log:
                self.serve(self.project, "--connection", "e.json", wait_for="@e.json", stdout=log, stderr=log)
        return self.serving[-1], self.footwall("status", "@e.json")

    def load(self):
        """Commands of all kinds, one after the other, some of which will fail when something is killed."""
        calls = (("batch", "job/JOB.json"),
                 ("isosurface", self.project, "--value", "0.5", "--out", "s.h5"),
                 ("render", self.project, "--isosurface", "amplitude=0.5", "--size", "200x150", "--out", "p.png"),
                 ("extract", self.project))
        number = 0
        while not self.over.is_set():
            call = calls[number % len(calls)]
            self.command = self.popen(*call, "--engine", "@e.json", "--json")
            number += 1
            try:
                out, err = self.command.communicate(timeout=PATIENCE)
            except subprocess.TimeoutExpired:
                self.command.kill()
                self.problems.append(f"{call} hangs")
                return
            code = json.loads(out)["error"]["code"] if self.command.returncode == 1 else ""
            if self.command.returncode not in (0, 1, -signal.SIGKILL) or code not in ("", "engine", "not_found"):
                self.problems.append(f"{call} ended with {self.command.returncode}: {out}{err}")

    def edit(self, number):
        """Edits that are acknowledged are known from then on. While a run is attached the project is held."""
        lines = [{"op": "add", "what": "fault", "name": f"E{number}"}]
        if number > 0:
            lines.append({"op": "delete", "what": "fault", "name": f"E{number - 1}"})
        for line in lines:
            def accepted(text=json.dumps(line) + "\n"):
                done = self.start("edit", self.project, "--json", stdin=text)
                if done.returncode == 0:
                    return True
                self.assertEqual(json.loads(done.stdout)["error"]["code"], "held", done.stdout + done.stderr)
                return False
            self.until(accepted, "the edit is never accepted")
        self.edits = self.names | {f"E{number}"}

    def victim(self, kind, serving, status):
        """The process of a kind, None where there is none at the moment."""
        ranks = [rank["process"] for rank in status["each_rank"]]
        if kind in ("mover", "caller"):
            return self.clients[kind].process.pid
        if kind == "command":
            return self.command.pid if self.command is not None and self.command.poll() is None else None
        return {"rank": random.choice(ranks), "rank 0": ranks[0], "serve": serving.pid,
                "keeper": next(iter(each for each in below(serving.pid) if name_of(each) == "footwall-keeper"), None),
                "launcher": next(iter(each for each in below(serving.pid)
                                      if name_of(each) not in ("", "footwall-keeper", "footwall-engine")), None)}[kind]

    def chosen_kinds(self, number):
        """One, or two, or now and then the whole engine at once."""
        if number < len(KINDS):
            return (KINDS[number],)
        lot = random.random()
        if lot < 0.05:
            return ENGINE
        return tuple(random.sample(KINDS, 2 if lot < 0.4 else 1))

    def test_kills(self):
        random.seed(SEED)
        begun = time.monotonic()
        longest = 0.0
        for number in range(KILLS):
            begun_round = time.monotonic()
            kinds = self.chosen_kinds(number)
            with self.subTest(number=number, kinds=kinds):
                self.one(number, kinds)
            if not self._outcome.success:
                break
            longest = max(longest, time.monotonic() - begun_round)
            if KILLS > 20:
                print(f"{number} {' + '.join(kinds)}: {time.monotonic() - begun_round:.1f} s", flush=True)
        print(f"{KILLS} kills in {time.monotonic() - begun:.0f} s, the longest took {longest:.1f} s")
        for client in self.clients.values():
            client.end()
        serving, _ = self.again()
        family = [serving.pid, *below(serving.pid)]
        self.footwall("stop", "@e.json")
        self.assertEqual(serving.wait(PATIENCE), 0)
        self.assert_nothing_is_left(family)
        self.assert_no_shared_memory(served=False)

    def one(self, number, kinds):
        serving, status = self.again()
        for kind in ("mover", "caller"):
            if kind not in self.clients or not self.clients[kind].alive():
                self.clients[kind] = Client(self, kind)
        for client in self.clients.values():
            client.wait_until_begun()
        self.over.clear()
        worker = threading.Thread(target=self.load)
        worker.start()
        try:
            self.edit(number)
            time.sleep(random.uniform(0, 0.7))  # the moment is any
            family = [serving.pid, *below(serving.pid)]
            victims = [each for each in (self.victim(kind, serving, status) for kind in kinds) if each is not None]
            self.kill_at_once(victims, self.victim("keeper", serving, status) if "serve" in kinds else None)
            self.assert_follows(kinds, serving, family)
        finally:
            self.over.set()
            worker.join()
        self.assertEqual(self.problems, [])
        self.again()
        for kind, client in self.clients.items():
            if kind in kinds:
                client.end()
            else:
                self.assertEqual(client.checked(), "ok", kind)
        self.assert_next_call_works()
        self.assert_no_shared_memory(served=True)

    def kill_at_once(self, victims, keeper):
        """The keeper does not see one without the others: it would end by itself, and leave the rest to serve."""
        for each, number in [(keeper, signal.SIGSTOP), *((victim, signal.SIGKILL) for victim in victims),
                             (keeper, signal.SIGCONT)]:
            try:
                if each is not None:
                    os.kill(each, number)
            except ProcessLookupError:
                pass  # it went with another one

    def assert_follows(self, kinds, serving, family):
        """Those that cannot go on without it end, too, and leave nothing."""
        if not set(kinds) & set(ENGINE):
            return
        if "serve" in kinds:
            serving.wait(PATIENCE)
        for each in family:
            if each != serving.pid:
                self.assertTrue(is_gone(each), f"{name_of(each)} outlives {kinds}")
        # Where both that could have cleaned are killed, the next start does; so it does where serve is killed while
        # it starts an engine again, between two keepers.
        if "serve" in kinds and "keeper" not in kinds:
            self.assertEqual([str(path) for path in self.runtime.rglob("*") if not path.is_dir()], [])
            self.assertFalse((self.folder / "e.json").exists())
            self.assertEqual(self.shared_memory_of(serving.pid), [])

    def assert_next_call_works(self):
        """On the faults that were there at the start: others have no pillars."""
        done = self.footwall("extract", self.project, "--engine", "@e.json")
        self.assertEqual(done["checksum"], self.expected)
        names = {fault["name"] for fault in self.footwall("faults", self.project)["faults"]}
        self.assertEqual(names, self.edits, "edits are lost")

    def assert_no_shared_memory(self, served):
        """Of engines of this test that are gone."""
        gone = self.serving[:-1] if served else self.serving
        self.assertEqual([name for serving in gone for name in self.shared_memory_of(serving.pid)], [])


if __name__ == "__main__":
    unittest.main()

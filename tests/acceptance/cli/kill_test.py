"""Whatever process is killed, at whatever moment of a mixed load: no edit is lost, nothing hangs, no process, socket or
shared memory stays, and the next call works. FOOTWALL_KILLS: how often (default 6)."""
import json
import os
import random
import signal
import threading
import time
import unittest

from served import PATIENCE, ServedTest, below, is_gone, name_of

KILLS = int(os.environ.get("FOOTWALL_KILLS", "6"))
SEED = int(os.environ.get("FOOTWALL_KILL_SEED", "7"))
VICTIMS = ("rank", "rank 0", "launcher", "client", "serve")


class Kill(ServedTest):
    def setUp(self):
        super().setUp()
        self.project = self.synthetic()
        self.expected = self.footwall("extract", self.project, "--ranks", "1")["checksum"]
        self.known = {fault["name"] for fault in self.footwall("faults", self.project)["faults"]}
        self.clients = []
        self.over = threading.Event()
        self.problems = []

    def again(self):
        """The serve process, started where there is none, once it answers."""
        # It gives up where it was killed too often, which is right, and a second one has to be started.
        if self.serving and self.answers(self.serving[-1], "@e.json"):
            process = self.serving[-1]
        else:
            process = self.serve(self.project, "--connection", "e.json", wait_for="@e.json")
        return process, self.footwall("status", "@e.json")

    def load(self):
        """Calls of all kinds, one after the other, some of which will fail when something is killed."""
        calls = (("extract", self.project, "--engine", "@e.json"),
                 ("isosurface", self.project, "--value", "0.5", "--out", "s.h5", "--engine", "@e.json"),
                 ("render", self.project, "--isosurface", "amplitude=0.5", "--size", "200x150", "--out", "p.png",
                  "--engine", "@e.json"),
                 ("status", "@e.json"))
        number = 0
        while not self.over.is_set():
            client = self.popen(*calls[number % len(calls)], "--json")
            self.clients.append(client)
            number += 1
            try:
                out, err = client.communicate(timeout=PATIENCE)
            except Exception as problem:  # a hang: told at the end, in the test's own thread
                client.kill()
                self.problems.append(f"{calls[number % len(calls)]}: {problem}")
                return
            if client.returncode not in (0, 1, -signal.SIGKILL):
                self.problems.append(f"status {client.returncode}: {out}{err}")

    def edit(self, name):
        """An edit that is acknowledged is known from then on. While a run is attached the project is held."""
        def accepted():
            line = json.dumps({"op": "add", "what": "fault", "name": name}) + "\n"
            done = self.start("edit", self.project, "--json", stdin=line)
            if done.returncode == 0:
                self.known.add(name)
                return True
            self.assertEqual(json.loads(done.stdout)["error"]["code"], "held", done.stderr)
            return False
        self.until(accepted, "the edit is never accepted")

    def victim(self, kind, process, status):
        ranks = [rank["process"] for rank in status["each_rank"]]
        if kind == "rank 0":
            return status["process"]
        if kind == "rank":
            return random.choice(ranks)
        if kind == "launcher":
            return next(each for each in below(process.pid) if each not in ranks and name_of(each) != "")
        if kind == "client" and self.clients:
            return self.clients[-1].pid if self.clients[-1].poll() is None else None
        return process.pid

    def test_kills(self):
        random.seed(SEED)
        for number in range(KILLS):
            process, status = self.again()
            self.over.clear()
            worker = threading.Thread(target=self.load)
            worker.start()
            try:
                self.edit(f"E{number}")
                time.sleep(random.uniform(0, 1.5))  # the moment is any
                kind = VICTIMS[number % len(VICTIMS)] if KILLS < 20 else random.choice(VICTIMS)
                family = [process.pid, *below(process.pid)]
                chosen = self.victim(kind, process, status)
                with self.subTest(number=number, kind=kind, victim=chosen):
                    if chosen is not None:
                        os.kill(chosen, signal.SIGKILL)
                        self.assert_follows(kind, process, family)
            finally:
                self.over.set()
                worker.join()
            self.assertEqual(self.problems, [])
            self.assert_next_call_works()
        process, _ = self.again()
        family = below(process.pid)
        self.footwall("stop", "@e.json")
        self.ended(process)
        for each in family:
            self.assertTrue(is_gone(each), name_of(each))
        self.assertEqual([name for one in self.serving for name in self.shared_memory_of(one.pid)
                          if one is process], [])

    def assert_follows(self, kind, process, family):
        """Those that cannot go on without it end, too."""
        if kind == "client":
            self.clients[-1].wait(PATIENCE)
            return
        if kind == "serve":
            process.communicate(timeout=PATIENCE)
        for each in family:
            if each != process.pid:
                self.assertTrue(is_gone(each), f"{name_of(each)} outlives its {kind}")

    def assert_next_call_works(self):
        """On the faults that were there at the start: others have no pillars."""
        self.again()
        done = self.footwall("extract", self.project, "--engine", "@e.json")
        self.assertEqual(done["checksum"], self.expected)
        names = {fault["name"] for fault in self.footwall("faults", self.project)["faults"]}
        self.assertEqual(self.known - names, set(), "edits are lost")


if __name__ == "__main__":
    unittest.main()

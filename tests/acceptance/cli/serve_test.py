"""footwall serve, status, stop and --engine: the same numbers and files as without, and nothing left behind."""
import contextlib
import hashlib
import json
import os
import pathlib
import shutil
import signal
import stat
import unittest

from served import ServedTest, below, is_gone


def digest(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


class Serve(ServedTest):
    def test_a_project_is_served_until_it_is_stopped(self):
        project = self.synthetic()
        self.footwall("extract", project, "--ranks", "1")  # makes the meshes
        process = self.serve(project, wait_for=project)
        (file,) = [path for path in (self.runtime / "footwall").iterdir() if path.suffix == ".json"]
        self.assertEqual(stat.S_IMODE(file.stat().st_mode), 0o600)
        token = json.loads(file.read_text())["token"]
        family = below(process.pid)
        self.assertGreaterEqual(len(family), 3)  # launcher and two ranks
        for each in family:
            self.assertNotIn(token, pathlib.Path(f"/proc/{each}/cmdline").read_text(errors="replace"))

        status = self.footwall("status", project)
        self.assertEqual(status["ranks"], 2)
        self.assertEqual(len(status["volumes"]), 1)
        faults = self.footwall("extract", project, "--ranks", "1")["faces"]
        self.assertEqual(status["faces"], faults)
        self.assertIn("volume", self.start("status", project).stdout)
        self.assertEqual(self.footwall("status", f"@{file}")["process"], status["process"])

        second = self.refused(1, "serve", project)
        self.assertEqual(second["code"], "held")
        self.assertIn(str(status["process"]), second["message"])
        self.assertEqual(self.refused(1, "status")["code"], "not_found")
        self.assertIn(project, self.refused(1, "status")["hint"])

        self.assertIn("stopped", self.footwall("stop", project))
        words = self.ended(process)
        self.assertIn("serving at unix:", words)
        self.assertNotIn(token, words)
        self.assert_nothing_is_left(family)
        self.assertEqual(self.shared_memory_of(process.pid), [])
        self.assertEqual(self.refused(1, "stop", project)["code"], "not_found")

    def test_signals_end_it_in_order(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number=number):
                process = self.serve()
                family = below(process.pid)
                self.stop(process, number)
                self.ended(process)
                self.assert_nothing_is_left(family)
                self.assertEqual(self.shared_memory_of(process.pid), [])

    def test_an_engine_that_dies_is_started_again_three_times_at_most(self):
        project = self.synthetic()
        self.footwall("extract", project, "--ranks", "1")
        process = self.serve(project, "--connection", "e.json", wait_for="@e.json")
        first = self.footwall("status", "@e.json")
        family = below(process.pid)
        before = first
        for victim in (0, 1):
            os.kill(before["each_rank"][victim]["process"], signal.SIGKILL)

            def another(old=before["process"]):
                done = self.start("status", "@e.json", "--json")
                return done.returncode == 0 and json.loads(done.stdout)["process"] != old
            self.until(another, "it is not started again")
            before = self.footwall("status", "@e.json")
            for name in ("address", "faces", "volumes", "ranks"):
                self.assertEqual(before[name], first[name], name)
            family += below(process.pid)
        os.kill(before["process"], signal.SIGKILL)
        words = self.ended(process, status=1)
        self.assertEqual(words.count("it is started again"), 2, words)
        self.assertIn("three times", words)
        self.assert_nothing_is_left(family)
        self.assertEqual(self.shared_memory_of(process.pid), [])

    def test_one_that_hangs_and_one_that_is_gone_are_told_as_such(self):
        project = self.synthetic()
        process = self.serve(project, "--connection", "e.json", wait_for="@e.json")
        rank = self.footwall("status", "@e.json")["process"]
        os.kill(rank, signal.SIGSTOP)
        error = self.refused(1, "status", "@e.json")
        self.assertEqual(error["code"], "engine")
        self.assertIn("does not answer", error["message"])
        self.assertIn(str(rank), error["hint"])
        os.kill(rank, signal.SIGCONT)
        self.footwall("status", "@e.json", "--wait", "60")
        # All at once, so that nobody can clean; parents last: the system lets stopped ones go on whose parent dies.
        family = [process.pid, *below(process.pid)]
        for each in family:
            os.kill(each, signal.SIGSTOP)
        for each in reversed(family):
            with contextlib.suppress(ProcessLookupError):  # the system ends some with their parents
                os.kill(each, signal.SIGKILL)
        process.wait()
        self.assertTrue(all(map(is_gone, family)))
        self.assertIn("has ended", self.refused(1, "status", "@e.json")["message"])
        self.assertNotEqual(self.shared_memory_of(process.pid), [])
        process.communicate()
        again = self.serve(project, "--connection", "e.json", wait_for="@e.json")
        self.assertEqual(self.shared_memory_of(process.pid), [])
        self.footwall("stop", "@e.json")
        self.ended(again)
        self.assert_nothing_is_left([])

    def test_two_projects_are_served_side_by_side(self):
        a, b = self.synthetic("a.footwall"), self.synthetic("b.footwall", seed=4)
        serving = [self.serve(project, wait_for=project, ranks=1) for project in (a, b)]
        self.assertNotEqual(*[self.footwall("status", project)["volumes"] for project in (a, b)])
        for project, process in zip((a, b), serving):
            self.footwall("stop", project)
            self.ended(process)

    def test_jobs_give_what_they_give_without(self):
        project = self.synthetic()
        shutil.copytree(f"{self.path(project)}.volumes", self.path("volumes"))
        # The project's own folder is not the engine's: volumes are found by checksum.
        process = self.serve("--connection", "e.json", "--volumes", "volumes", wait_for="@e.json")
        engine = ("--engine", "@e.json")
        own = ("--ranks", "2")

        numbers = [self.footwall("extract", project, *how) for how in (own, engine)]
        self.assertEqual(numbers[0]["checksum"], numbers[1]["checksum"])
        self.assertEqual(numbers[0]["faults"], numbers[1]["faults"])

        for suffix in ("h5", "vtp"):
            for how, name in ((own, "own"), (engine, "engine")):
                self.footwall("isosurface", project, "--value", "0.5", "--out", f"{name}.{suffix}", *how)
            self.assertEqual(digest(self.path(f"own.{suffix}")), digest(self.path(f"engine.{suffix}")))

        for more in ((), ("--visible",)):
            for how, name in ((own, "own"), (engine, "engine")):
                self.footwall("render", project, "--isosurface", "amplitude=0.5", "--size", "200x150", "--out",
                              f"{name}.png", "--depth", f"{name}.tif", *more, *how)
            for suffix in ("png", "tif"):
                self.assertEqual(digest(self.path(f"own.{suffix}")), digest(self.path(f"engine.{suffix}")), more)

        made = [self.footwall("attribute", project, "--name", name, *how) for how, name in ((own, "o"), (engine, "e"))]
        self.assertEqual(made[0]["checksum"], made[1]["checksum"])

        self.assertEqual(os.listdir(self.temporary), [])
        self.footwall("stop", "@e.json")
        self.ended(process)
        gone = self.refused(1, "extract", project, *engine)
        self.assertEqual(gone["code"], "not_found")

    def test_secrets_are_asked_for_and_kept(self):
        project = self.synthetic()
        (self.folder / "volumes").mkdir()
        process = self.serve("--connection", "e.json", "--volumes", "volumes", wait_for="@e.json", ranks=1)
        connection = json.loads((self.folder / "e.json").read_text())
        # By its address, as over a tunnel.
        env = {"FOOTWALL_ENGINE_TOKEN": connection["token"]}
        self.assertEqual(self.footwall("status", connection["address"], env=env)["ranks"], 1)
        strange = self.start("status", connection["address"], "--json", env={"FOOTWALL_ENGINE_TOKEN": "x" * 64})
        self.assertEqual(strange.returncode, 1)
        self.assertEqual(json.loads(strange.stdout)["error"]["code"], "invalid")
        os.chmod(self.path("e.json"), 0o644)
        self.assertEqual(self.refused(1, "status", "@e.json")["code"], "invalid")
        os.chmod(self.path("e.json"), 0o600)
        both = self.refused(2, "extract", project, "--engine", "@e.json", "--ranks", "2")
        self.assertIn("--ranks", both["message"])
        self.stop(process)
        self.ended(process)

    def test_tcp_is_encrypted_and_its_certificate_pinned(self):
        project = self.synthetic()
        process = self.serve(project, "--connection", "e.json", "--listen", "tcp:127.0.0.1:0", wait_for="@e.json", ranks=1)
        connection = json.loads((self.folder / "e.json").read_text())
        self.assertRegex(connection["fingerprint"], r"^([0-9A-F]{2}:){31}[0-9A-F]{2}$")
        own = self.footwall("extract", project, "--ranks", "1")
        self.assertEqual(self.footwall("extract", project, "--engine", "@e.json")["checksum"], own["checksum"])
        # The certificate of another engine.
        self.env["XDG_STATE_HOME"] = str(self.folder / "other")
        other = self.serve("--connection", "o.json", "--listen", "tcp:127.0.0.1:0", wait_for="@o.json", ranks=1)
        wrong = {**connection, "certificate": json.loads((self.folder / "o.json").read_text())["certificate"]}
        self.assertNotEqual(wrong["certificate"], connection["certificate"])
        (self.folder / "e.json").write_text(json.dumps(wrong))
        self.assertEqual(self.refused(1, "status", "@e.json")["code"], "invalid")
        (self.folder / "e.json").write_text(json.dumps(connection))
        for file, each in (("@e.json", process), ("@o.json", other)):
            self.footwall("stop", file)
            self.assertIn("fingerprint", self.ended(each))

    def test_a_client_goes_on_after_a_restart(self):
        (self.folder / "token").write_text("0123456789abcdef" * 4)
        os.chmod(self.path("token"), 0o600)
        self.env["FOOTWALL_ENGINE_TOKEN_FILE"] = self.path("token")
        first = self.serve("--connection", "e.json", "--listen", "tcp:127.0.0.1:0", wait_for="@e.json", ranks=1)
        shutil.copy(self.path("e.json"), self.path("kept.json"))
        address = json.loads((self.folder / "kept.json").read_text())["address"]
        self.footwall("stop", "@e.json")
        self.ended(first)
        second = self.serve("--connection", "e.json", "--listen", address, wait_for="@kept.json", ranks=1)
        self.assertEqual(self.footwall("status", "@kept.json")["address"], address)
        state = self.folder / "state" / "footwall" / "engine"
        self.assertEqual(os.listdir(state), ["engine.pem"])
        self.assertEqual([stat.S_IMODE(path.stat().st_mode) for path in (state, state / "engine.pem")], [0o700, 0o600])
        self.footwall("stop", "@kept.json")
        self.ended(second)
        os.chmod(state, 0o755)
        third = self.popen("serve", "--listen", address, "--ranks", 1)
        self.assertIn(f"chmod 700 {state}", self.ended(third, 2))
        # Nor one that can be guessed.
        (self.folder / "token").write_text("short")
        self.assertIn("32 characters", self.ended(self.popen("serve", "--ranks", 1), 2))

    def test_wrong_words_are_refused(self):
        for words in (("--listen", "somewhere"), ("--memory", "much"), ("--ranks", "0")):
            self.refused(2, "serve", *words)
        self.refused(1, "serve", "nothing.footwall")
        self.refused(1, "serve", "--volumes", "nowhere")
        self.refused(2, "status", "--wait", "-1")
        self.assertEqual(self.refused(1, "status")["code"], "not_found")
        self.assert_nothing_is_left([])


class Held(ServedTest):
    def test_an_edit_of_a_project_that_somebody_holds_names_the_holder(self):
        project = self.synthetic()
        holder = self.popen("edit", project, stdin=-1)
        try:
            holder.stdin.write('{"op":"add","what":"fault","name":"held"}\n')
            holder.stdin.flush()
            self.assertIn("fault", holder.stdout.readline())
            refused = self.refused(1, "edit", project, stdin='{"op":"add","what":"fault","name":"other"}\n')
            self.assertEqual(refused["code"], "held")
            self.assertIn(str(holder.pid), refused["message"])
        finally:
            holder.communicate()
        self.assertTrue(is_gone(holder.pid))
        names = [fault["name"] for fault in self.footwall("faults", project)["faults"]]
        self.assertIn("held", names)
        self.assertNotIn("other", names)


if __name__ == "__main__":
    unittest.main()

"""footwall-engine serve: ready, private, ended in order."""
import json
import os
import pathlib
import signal
import stat
import subprocess
import unittest

from support import BIN, FootwallTest

TOKEN = "0123456789abcdef0123456789abcdef"
QUIET = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMP_NUM_THREADS": "1",
         "OMPI_MCA_rmaps_base_oversubscribe": "1"}


class ServeEngine(FootwallTest):
    def serve(self, *words, ranks=2, token=TOKEN):
        env = {**os.environ, **QUIET}
        env.pop("FOOTWALL_ENGINE_TOKEN", None)
        if token:
            env["FOOTWALL_ENGINE_TOKEN"] = token
        process = subprocess.Popen(
            ["mpiexec", "-n", str(ranks), str(BIN / "footwall-engine"), "serve", "--folder", self.path("engine"), *words],
            stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True, cwd=self.folder, env=env)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def line_of(self, process, key):
        for line in process.stderr:
            if line.startswith("{") and key in json.loads(line):
                return json.loads(line)[key]
        return self.fail(f"the engine ended with {process.wait()} and no {key}")

    def test_ready_private_and_ended_by_a_signal(self):
        socket = self.folder / "engine" / "socket"
        engine = self.serve("--listen", f"unix:{socket}")
        ready = self.line_of(engine, "ready")
        self.assertEqual(ready["address"], f"unix:{socket}")
        self.assertEqual((ready["ranks"], ready["fingerprint"], ready["certificate"]), (2, "", ""))
        self.assertTrue(stat.S_ISSOCK(socket.stat().st_mode))
        self.assertEqual(stat.S_IMODE(socket.stat().st_mode), 0o600)
        self.assertEqual(stat.S_IMODE(socket.parent.stat().st_mode), 0o700)
        rank0 = pathlib.Path("/proc") / str(ready["process"])
        self.assertNotIn(TOKEN.encode(), (rank0 / "environ").read_bytes())
        self.assertNotIn(TOKEN.encode(), (rank0 / "cmdline").read_bytes())
        os.kill(ready["process"], signal.SIGTERM)
        engine.communicate(timeout=60)
        self.assertEqual(engine.returncode, 0)
        self.assertFalse(socket.exists())

    def test_tcp_tells_port_and_certificate(self):
        token = self.folder / "token"
        token.write_text(TOKEN + "\n")
        engine = self.serve("--listen", "tcp:127.0.0.1:0", "--token-file", str(token), ranks=2, token=None)
        ready = self.line_of(engine, "ready")
        self.assertRegex(ready["address"], r"^tcp:127\.0\.0\.1:[1-9][0-9]*$")
        self.assertRegex(ready["fingerprint"], r"^([0-9A-F]{2}:){31}[0-9A-F]{2}$")
        self.assertIn("BEGIN CERTIFICATE", ready["certificate"])
        key = self.folder / "engine" / "certificate" / "engine.pem"
        self.assertEqual(stat.S_IMODE(key.stat().st_mode), 0o600)
        os.kill(ready["process"], signal.SIGINT)
        engine.communicate(timeout=60)
        self.assertEqual(engine.returncode, 0)

    def test_refusals(self):
        socket = f"unix:{self.path('engine/socket')}"
        for words, token, code in (
            (("--listen", socket), None, "usage"),
            (("--listen", socket), "short", "usage"),
            (("--listen", "nowhere"), TOKEN, "usage"),
            (("--listen", "tcp:127.0.0.1"), TOKEN, "usage"),
            (("--listen", socket, "--token-file", "absent"), TOKEN, "not_found"),
        ):
            engine = self.serve(*words, token=token)
            self.assertEqual(self.line_of(engine, "error")["code"], code, words)
            engine.communicate(timeout=60)
            self.assertEqual(engine.returncode, 2 if code == "usage" else 1, words)


if __name__ == "__main__":
    unittest.main()

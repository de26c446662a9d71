"""footwall doctor: what is not fit for work is said with what to do, and nothing is left behind."""
import json
import os
import signal
import stat
import subprocess
import unittest

from support import BIN, FootwallTest


class Doctor(FootwallTest):
    def checks(self, status, *arguments, env=None):
        done = self.start("doctor", *arguments, "--json", "--quiet", env=env)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        checks = {check["name"]: check for check in json.loads(done.stdout)["checks"]}
        for check in checks.values():
            self.assertEqual(set(check), {"name", "status", "what", "hint"})
            self.assertIn(check["status"], ("ok", "warning", "failed"))
            self.assertTrue(check["what"], check)
            if check["status"] != "ok":
                self.assertTrue(check["hint"], f"what to do? {check}")
        return checks

    def launcher(self, script):
        path = self.folder / "launcher"
        path.write_text("#!/bin/sh\n" + script)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return {"FOOTWALL_LAUNCHER": str(path)}

    def test_this_machine_is_fit_for_work(self):
        checks = self.checks(0)
        for name in ("cores", "memory", "engine", "MPI library", "parallel HDF5", "shared memory", "temporary folder",
                     "disk space", "disk speed", "SQLite", "text", "OpenGL"):
            self.assertIn(name, checks)
        self.assertEqual(checks["engine"]["status"], "ok", checks["engine"])
        self.assertEqual(checks["parallel HDF5"]["status"], "ok", checks["parallel HDF5"])
        self.assertEqual(os.listdir(self.folder), [])

    def test_this_folder_is_fit_for_work(self):
        checks = self.checks(0, "--path", self.folder)
        for name in ("file system", "space", "permissions", "names", "locks", "renaming", "flushing", "project", "engine",
                     "parallel HDF5", "speed"):
            self.assertNotEqual(checks[name]["status"], "failed", checks[name])
        self.assertIn("MB/s", checks["speed"]["what"])
        self.assertEqual(os.listdir(self.folder), [])

    def test_an_engine_that_does_not_start_fails_with_its_words(self):
        checks = self.checks(1, env=self.launcher("echo the network is down; exit 1"))
        self.assertEqual(checks["engine"]["status"], "failed")
        self.assertIn("the network is down", checks["engine"]["hint"])
        self.assertNotIn("MPI library", checks)
        self.assertIn("SQLite", checks, "the other checks go on")
        text = self.start("doctor", env=self.launcher("exit 1"))
        self.assertEqual(text.returncode, 1)
        self.assertRegex(text.stdout, r"engine +failed +")

    def test_a_launcher_of_another_mpi_is_told(self):
        # Starts the engine twice, each in a world of its own.
        checks = self.checks(1, env=self.launcher('"$@"; exec "$@"'))
        self.assertEqual(checks["engine"]["status"], "failed")
        self.assertIn("world of 1", checks["engine"]["what"])

    def test_folders_that_are_of_no_use(self):
        self.assertIn("no folder", self.checks(1, "--path", self.path("nowhere"))["file system"]["what"])
        checks = self.checks(1, "--path", "/proc")
        self.assertEqual(checks["permissions"]["status"], "failed")
        if os.geteuid() == 0 and subprocess.run(["mount", "-t", "tmpfs", "-o", "ro", "none", self.folder],
                                                capture_output=True).returncode == 0:
            self.addCleanup(subprocess.run, ["umount", str(self.folder)], check=True)
            self.assertIn("read-only", self.checks(1, "--path", self.folder)["file system"]["what"])

    def test_ctrl_c_leaves_nothing(self):
        running = subprocess.Popen([str(BIN / "footwall"), "doctor", "--path", str(self.folder)], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        for line in running.stderr:
            if "project" in line:
                break
        self.assertNotEqual(os.listdir(self.folder), [])
        running.send_signal(signal.SIGINT)
        running.communicate(timeout=60)
        self.assertEqual(running.returncode, 130)
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    unittest.main()

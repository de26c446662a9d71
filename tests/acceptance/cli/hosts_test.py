"""Several hosts: two network namespaces on this machine, with host names of their own, joined by one wire; ranks talk over
TCP and are started over there through an agent, as by ssh."""
import json
import os
import pathlib
import shlex
import shutil
import signal
import subprocess
import time
import unittest

from jobs_test import AS_ROOT
from processes import go_on, is_rank, stopped_ranks
from support import BIN, FootwallTest

HERE, THERE = f"fw{os.getpid()}a", f"fw{os.getpid()}b"
NETWORK = f"10.{77 + os.getpid() % 100}.{os.getpid() // 100 % 250}"


def quiet(*words):
    return subprocess.run(words, capture_output=True, text=True)


def why_not():
    """Why this machine cannot play two hosts; empty where it can."""
    if os.geteuid() != 0:
        return "only root makes network namespaces"
    for tool in ("ip", "unshare", "mpirun", "hostname"):
        if shutil.which(tool) is None:
            return f"there is no {tool}"
    if "Open MPI" not in quiet("mpirun", "--version").stdout:
        return "mpirun is not Open MPI's"
    made = quiet("ip", "netns", "add", HERE)
    if made.returncode != 0:
        return made.stderr.strip()
    return ""


def end_hosts():
    for name in (HERE, THERE):
        quiet("ip", "netns", "del", name)


def setUpModule():
    reason = why_not()
    if reason:
        raise unittest.SkipTest(f"skipped: no network namespaces here ({reason})")
    unittest.addModuleCleanup(end_hosts)
    for words in (f"netns add {THERE}", f"link add {HERE}v netns {HERE} type veth peer name {THERE}v netns {THERE}",
                  f"-n {HERE} addr add {NETWORK}.1/24 dev {HERE}v", f"-n {THERE} addr add {NETWORK}.2/24 dev {THERE}v",
                  f"-n {HERE} link set lo up", f"-n {THERE} link set lo up",
                  f"-n {HERE} link set {HERE}v up", f"-n {THERE} link set {THERE}v up"):
        done = quiet("ip", *words.split())
        if done.returncode != 0:
            raise unittest.SkipTest(f"skipped: no network namespaces here (ip {words}: {done.stderr.strip()})")


class Hosts(FootwallTest):
    def setUp(self):
        super().setUp()
        inside = "ip netns exec {0} unshare --uts sh -c 'hostname {0}; exec \"$@\"' sh"
        self.executable("agent", f"shift\nexec {inside.format(THERE)} sh -c \"$*\"")
        self.executable("start", f"""
ranks=$1; shift
exec {inside.format(HERE)} mpirun --mca plm_rsh_agent {shlex.quote(self.path('agent'))} --mca btl tcp,self,vader \\
  --mca btl_vader_single_copy_mechanism none --mca btl_tcp_if_include {NETWORK}.0/24 --mca oob_tcp_if_include {NETWORK}.0/24 \\
  --bind-to none --map-by node --host {NETWORK}.1:8,{NETWORK}.2:8 -n "$ranks" "$@"
""")
        self.two_hosts = {**AS_ROOT, "FOOTWALL_LAUNCHER": f"{self.path('start')} {{ranks}}"}

    def executable(self, name, text):
        path = pathlib.Path(self.path(name))
        path.write_text(f"#!/bin/sh\n{text}\n")
        path.chmod(0o755)

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

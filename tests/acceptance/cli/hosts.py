"""Two hosts on this machine: network namespaces with host names of their own, joined by one wire. Ranks talk over TCP and
are started over there through an agent, as by ssh. Each host has a /dev/shm of its own."""
import os
import pathlib
import shlex
import shutil
import subprocess
import unittest

from jobs_test import AS_ROOT

HERE, THERE = f"fw{os.getpid()}a", f"fw{os.getpid()}b"
NETWORK = f"10.{77 + os.getpid() % 100}.{os.getpid() // 100 % 250}"


def quiet(*words):
    return subprocess.run(words, capture_output=True, text=True)


def why_not():
    """Why this machine cannot play two hosts; empty where it can, and then the first is made."""
    if os.geteuid() != 0:
        return "only root makes network namespaces"
    for tool in ("ip", "unshare", "mount", "mpirun", "hostname"):
        if shutil.which(tool) is None:
            return f"there is no {tool}"
    if "Open MPI" not in quiet("mpirun", "--version").stdout:
        return "mpirun is not Open MPI's"
    if quiet("unshare", "--mount", "mount", "-t", "tmpfs", "none", "/dev/shm").returncode != 0:
        return "nothing can be mounted"
    made = quiet("ip", "netns", "add", HERE)
    if made.returncode != 0:
        return made.stderr.strip()
    return ""


def end_hosts():
    for name in (HERE, THERE):
        quiet("ip", "netns", "del", name)


def join_hosts():
    """The other host and the wire, after why_not(); raises OSError."""
    for words in (f"netns add {THERE}", f"link add {HERE}v netns {HERE} type veth peer name {THERE}v netns {THERE}",
                  f"-n {HERE} addr add {NETWORK}.1/24 dev {HERE}v", f"-n {THERE} addr add {NETWORK}.2/24 dev {THERE}v",
                  f"-n {HERE} link set lo up", f"-n {THERE} link set lo up",
                  f"-n {HERE} link set {HERE}v up", f"-n {THERE} link set {THERE}v up"):
        done = quiet("ip", *words.split())
        if done.returncode != 0:
            raise OSError(f"ip {words}: {done.stderr.strip()}")


def make_hosts():
    """For setUpModule: makes them until the module ends, or skips it."""
    reason = why_not()
    if not reason:
        unittest.addModuleCleanup(end_hosts)
        try:
            join_hosts()
            return
        except OSError as error:
            reason = str(error)
    raise unittest.SkipTest(f"skipped: no network namespaces here ({reason})")


def on_host(name, hidden=("/dev/shm",)):
    """Words that begin a command on a host; hidden: folders that it has of its own, empty at first."""
    mounts = "".join(f"mount -t tmpfs none {shlex.quote(str(folder))} && " for folder in hidden)
    return ["ip", "netns", "exec", name, "unshare", "--uts", "--mount", "sh", "-c",
            f"{mounts}hostname {name} && exec \"$@\"", "sh"]


def running_on(name):
    """The ids of all processes of a host."""
    return list(map(int, quiet("ip", "netns", "pids", name).stdout.split()))


def launcher(folder):
    """The environment in which the programs start their ranks on both hosts, by turns; its scripts go into a folder."""
    folder = pathlib.Path(folder)

    def executable(name, text):
        (folder / name).write_text(f"#!/bin/sh\n{text}\n")
        (folder / name).chmod(0o755)
        return folder / name

    agent = executable("agent", f"shift\nexec {shlex.join(on_host(THERE))} sh -c \"$*\"")
    start = executable("start", f"""
ranks=$1; shift
exec {shlex.join(on_host(HERE, hidden=()))} mpirun --mca plm_rsh_agent {shlex.quote(str(agent))} --mca btl tcp,self,vader \\
  --mca btl_vader_single_copy_mechanism none --mca btl_tcp_if_include {NETWORK}.0/24 --mca oob_tcp_if_include {NETWORK}.0/24 \\
  --mca mpi_yield_when_idle 1 --mca odls_base_sigkill_timeout 0 \\
  --bind-to none --map-by node --host {NETWORK}.1:8,{NETWORK}.2:8 -n "$ranks" "$@"
""")
    return {**AS_ROOT, "FOOTWALL_LAUNCHER": f"{start} {{ranks}}"}

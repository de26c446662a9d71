"""Runs of the program that are held in the middle: their ranks are found and stopped, and looked for afterwards."""
import os
import pathlib
import select
import signal
import subprocess

from support import BIN, FootwallTest


def children(process):
    """The ids of all processes below this one."""
    found = []
    try:
        below = pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split()
    except OSError:
        return found
    for child in map(int, below):
        found += [child, *children(child)]
    return found


def is_rank(process):
    """Whether it is an engine that has got as far as to heed signals."""
    try:
        if b"footwall-engine" not in pathlib.Path(f"/proc/{process}/cmdline").read_bytes().split(b"\0")[0]:
            return False
        (caught,) = [line.split()[1] for line in pathlib.Path(f"/proc/{process}/status").read_text().splitlines()
                     if line.startswith("SigCgt:")]
    except OSError:
        return False
    return bool(int(caught, 16) >> (signal.SIGTERM - 1) & 1)


def stopped_ranks(program, count, once=lambda: True):
    """The ranks below a run, found and, once something is so, stopped, so that it cannot end by itself; fewer where it ended
    before."""
    ranks = []
    while (len(ranks) < count or not once()) and program.poll() is None:
        if len(ranks) < count:
            ranks = [process for process in children(program.pid) if is_rank(process)]
    for rank in ranks:
        os.kill(rank, signal.SIGSTOP)
    return ranks


def go_on(processes):
    for process in processes:
        try:
            os.kill(process, signal.SIGCONT)
        except ProcessLookupError:
            pass


class HeldRuns(FootwallTest):
    def setUp(self):
        super().setUp()
        (self.folder / "tmp").mkdir()  # the programs' TMPDIR

    def held(self, ranks, *arguments, once=lambda: True):
        """A run of the program whose ranks were found and, once something is so, stopped, so that it cannot end by itself:
        (process, all below it, those that are ranks)."""
        program = subprocess.Popen([str(BIN / "footwall"), *arguments, "--ranks", str(ranks)], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, cwd=self.folder,
                                   env={**os.environ, "TMPDIR": self.path("tmp")})
        found = stopped_ranks(program, ranks, once)
        self.assertIsNone(program.poll(), "it ended before it could be stopped")
        return program, children(program.pid), found

    def assert_gone(self, processes):
        """Waits, without sleeping, until none of them runs: the last may be on its way out."""
        for process in processes:
            try:
                descriptor = os.pidfd_open(process)
            except ProcessLookupError:
                continue
            try:
                self.assertTrue(select.select([descriptor], [], [], 60)[0], f"process {process} outlived the program")
            finally:
                os.close(descriptor)

"""A resident engine for a test: started, watched and ended, with all of its processes accounted for."""
import os
import pathlib
import select
import signal
import subprocess
import time

from support import BIN, FootwallTest

PATIENCE = 120  # seconds, for whatever is waited for


def below(process):
    """The ids of all processes below this one, whichever of its threads started them."""
    found = []
    for tasks in pathlib.Path(f"/proc/{process}/task").glob("*/children"):
        try:
            children = list(map(int, tasks.read_text().split()))
        except OSError:
            continue
        for child in children:
            found += [child, *below(child)]
    return found


def name_of(process):
    try:
        return pathlib.Path(f"/proc/{process}/comm").read_text().strip()
    except OSError:
        return ""


def is_gone(process):
    """Waits, without sleeping, until it has ended."""
    try:
        descriptor = os.pidfd_open(process)
    except ProcessLookupError:
        return True
    try:
        return bool(select.select([descriptor], [], [], PATIENCE)[0])
    finally:
        os.close(descriptor)


class ServedTest(FootwallTest):
    def setUp(self):
        super().setUp()
        self.runtime = self.folder / "runtime"
        self.runtime.mkdir(mode=0o700)
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir()
        self.env = {"XDG_RUNTIME_DIR": str(self.runtime), "TMPDIR": str(self.temporary),
                    "XDG_STATE_HOME": str(self.folder / "state")}
        self.serving = []
        self.addCleanup(self.end_all)

    def end_all(self):
        for process in self.serving:
            if process.poll() is None:
                process.kill()
            process.communicate()

    def start(self, *arguments, stdin=None, env=None):
        return super().start(*arguments, stdin=stdin, env={**self.env, **(env or {})})

    def popen(self, *arguments, **how):
        return subprocess.Popen([str(BIN / "footwall"), *map(str, arguments)], text=True, cwd=self.folder,
                                env={**os.environ, **self.env},
                                **{"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **how})

    def serve(self, *arguments, wait_for="", ranks=2, **how):
        """A `footwall serve` that answers; wait_for: how status is to find it. how: of popen()."""
        process = self.popen("serve", *arguments, "--ranks", ranks, **how)
        self.serving.append(process)
        if not self.answers(process, wait_for):
            self.fail(f"no engine: {process.communicate()}")
        return process

    def answers(self, process, wait_for):
        """Waits until the engine of this serve answers; False where serve has ended."""
        end = time.monotonic() + PATIENCE
        while process.poll() is None:
            done = self.start("status", *([wait_for] if wait_for else []), "--wait", "1")
            if done.returncode == 0:
                return True
            if time.monotonic() > end:
                process.kill()
                self.fail(f"it neither serves nor ends: {done.stderr}\n{process.communicate()}")
        return False

    def ended(self, process, status=0):
        """What a serve said that ends, or has ended, with this status."""
        out, err = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, status, out + err)
        return out + err

    def assert_nothing_is_left(self, processes):
        for process in processes:
            self.assertTrue(is_gone(process), f"process {process} ({name_of(process)}) is left")
        self.assertEqual([str(path) for path in self.runtime.rglob("*") if not path.is_dir()], [])
        self.assertEqual(os.listdir(self.temporary), [])

    def shared_memory_of(self, process):
        """The private folders of a process in /dev/shm."""
        return [name for name in os.listdir("/dev/shm") if name.startswith("footwall-") and f"-{process}-" in name]

    def until(self, condition, what):
        end = time.monotonic() + PATIENCE
        while not condition():
            self.assertLess(time.monotonic(), end, what)
            time.sleep(0.01)

    @staticmethod
    def stop(process, number=signal.SIGTERM):
        process.send_signal(number)

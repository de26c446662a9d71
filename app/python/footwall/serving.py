"""`footwall serve` as a child of the script, which does not outlive it."""
import ctypes
import signal
import subprocess
import tempfile
import threading
import time

from .errors import Error

PR_SET_PDEATHSIG = 1


def prepared_to_die():
    """In the child, before it becomes `footwall`: it gets SIGTERM when the thread that started it ends."""
    ctypes.CDLL(None, use_errno=True).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)


class Served:
    """`footwall serve` as a child. A thread of its own starts it and stays, since its death would end the child."""

    def __init__(self, words, file):
        self.file = file
        self._command = words
        self._words = tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace")
        self._process = None
        self._problem = None
        self._started = threading.Event()
        threading.Thread(target=self._run, args=(words,), daemon=True).start()
        self._started.wait()
        if self._problem is not None:
            raise self._problem

    def _run(self, words):
        try:
            self._process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=self._words, stderr=self._words,
                                             start_new_session=True, preexec_fn=prepared_to_die)
        except OSError as error:
            self._problem = Error("engine", f"footwall cannot be started: {error}")
        finally:
            self._started.set()
        if self._process is not None:
            self._process.wait()

    def wait_until_ready(self, seconds):
        deadline = time.monotonic() + seconds
        while not self.file.exists():
            status = self._process.poll()
            if status is not None:
                raise Error("engine", "the engine did not start: " + self._last_words(status))
            if time.monotonic() > deadline:
                raise Error("engine", f"the engine was not ready within {seconds} seconds", self._last_words(None))
            time.sleep(0.02)

    def revived(self):
        """The one that runs, which is another one where this was killed. Raises Error with its last words where it
        has given up."""
        status = self._process.poll()
        if status is None:
            return self
        if status >= 0:
            raise Error("engine", "the engine has ended: " + self._last_words(status), "start another one")
        self._words.close()
        return Served(self._command, self.file)

    def kill(self):
        """Its keeper ends what it leaves."""
        self._process.kill()
        self._process.wait()

    def _last_words(self, status):
        self._words.seek(0)
        lines = self._words.read().strip().splitlines()
        return lines[-1] if lines else f"it ended with status {status} and no word"

    def end(self):
        if self._process.poll() is None:
            self._process.terminate()
            try:
                self._process.wait(timeout=20)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
        self._words.close()

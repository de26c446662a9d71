"""Runs a program on a screen of its own, with software OpenGL and settings that are thrown away.

on_a_screen.py PROGRAM [ARGUMENT ...]: exits as the program does, or with 77 and one line where there is no Xvfb.
"""
import ctypes
import os
import shutil
import signal
import subprocess
import sys
import tempfile


def end_with_parent() -> None:
    """Called in a child: it is killed when this program is, also by kill -9 at a time limit."""
    PR_SET_PDEATHSIG = 1
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def main() -> int:
    if shutil.which("Xvfb") is None:
        print("SKIPPED: no Xvfb (package xvfb), so no window can be opened")
        return 77
    reader, writer = os.pipe()
    screen = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writer), "-screen", "0", "1600x1000x24", "-nolisten", "tcp"],
        pass_fds=[writer], stderr=subprocess.DEVNULL, preexec_fn=end_with_parent)
    os.close(writer)
    try:
        with os.fdopen(reader) as number, tempfile.TemporaryDirectory(prefix="footwall-ui-") as home:
            display = number.readline().strip()
            if not display:
                print("Xvfb did not start", file=sys.stderr)
                return 1
            environment = {**os.environ, "DISPLAY": f":{display}", "QT_QPA_PLATFORM": "xcb", "HOME": home,
                           "LIBGL_ALWAYS_SOFTWARE": "1", "XDG_RUNTIME_DIR": home, "XDG_CONFIG_HOME": home,
                           "XDG_DATA_HOME": home, "XDG_CACHE_HOME": home}
            return subprocess.call(sys.argv[1:], env=environment, preexec_fn=end_with_parent)
    finally:
        screen.terminate()
        screen.wait()


if __name__ == "__main__":
    sys.exit(main())

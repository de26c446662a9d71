"""Runs the `footwall` program, whose JSON is what this package reads and whose commands write the project."""
import json
import os
import pathlib
import shutil
import subprocess

from .errors import Error


def program():
    """The path of `footwall`: $FOOTWALL_PROGRAM, that of the build tree this package lies in, or from PATH."""
    named = os.environ.get("FOOTWALL_PROGRAM")
    if named:
        return named
    beside = pathlib.Path(__file__).resolve().parents[2] / "bin" / "footwall"
    found = str(beside) if beside.is_file() else shutil.which("footwall")
    if not found:
        raise Error("not_found", "the program footwall is not installed",
                    "put it on the PATH, or its path into FOOTWALL_PROGRAM")
    return found


def error_of(answer, status, words):
    """The Error of a failed command: from its JSON, else from its last words."""
    try:
        error = json.loads(answer)["error"]
        return Error(error["code"], error["message"], error.get("hint", ""))
    except (ValueError, KeyError, TypeError):
        last = words.strip().splitlines()
        return Error("internal", last[-1] if last else f"footwall ended with status {status} and no word")


def run(*words, text=None):
    """Runs a command with --json and returns its answer as a dict.

    words: after `footwall`; paths and numbers may stand as they are. text: its standard input. Raises Error as the
    command says, "not_found" where the program is not there.
    """
    try:
        done = subprocess.run([program(), *map(str, words), "--json"], input=text if text is not None else "",
                              capture_output=True, encoding="utf-8", errors="replace", check=False)
    except OSError as error:
        raise Error("not_found", f"footwall cannot be started: {error}") from None
    if done.returncode != 0:
        raise error_of(done.stdout, done.returncode, done.stderr)
    try:
        return json.loads(done.stdout)
    except ValueError:
        raise Error("internal", f"footwall {words[0]} did not answer in JSON") from None

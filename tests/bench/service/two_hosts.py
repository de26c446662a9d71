"""Runs an MPI program with its ranks on two hosts, by turns: network namespaces of this machine. Needs root and Open MPI.
    FOOTWALL_BIN=build/release/bin python3 tests/bench/service/two_hosts.py 2 build/release/bin/bench_service 1000 1"""
import os
import pathlib
import subprocess
import sys
import tempfile

os.environ.setdefault("FOOTWALL_SOURCE", str(pathlib.Path(__file__).parents[3]))
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "acceptance" / "cli"))

import hosts  # noqa: E402


def main(ranks, *program):
    reason = hosts.why_not()
    if reason:
        sys.exit(f"no network namespaces here ({reason})")
    try:
        hosts.join_hosts()
        with tempfile.TemporaryDirectory(prefix="footwall-hosts-") as folder:
            env = {**os.environ, **hosts.launcher(folder)}
            return subprocess.run([f"{folder}/start", ranks, *program], env=env, check=False).returncode
    finally:
        hosts.end_hosts()


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))

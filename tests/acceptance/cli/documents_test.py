"""Every command in the README and in docs/ runs as printed: each ```console block, line by line, in one folder a page."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from support import BIN, SOURCE, test_data

PAGES = [SOURCE / "README.md", *sorted((SOURCE / "docs").rglob("*.md"))]


def commands(page):
    """(line number, command) of each line starting with '$ ' in a ```console block; a trailing \\ continues."""
    found, inside, pending = [], False, None
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if line.startswith("```"):
            inside = line.strip() == "```console"
        elif inside and pending is not None:
            found[-1] = (pending, found[-1][1][:-1] + line.strip())
        elif inside and line.startswith("$ "):
            found.append((number, line[2:]))
        pending = found[-1][0] if inside and found and found[-1][1].endswith("\\") else None
    return found


class Documents(unittest.TestCase):
    def test_every_command_runs(self):
        ran = 0
        for page in PAGES:
            folder = pathlib.Path(tempfile.mkdtemp(prefix="footwall-docs-"))
            self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
            environment = {**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}"}
            for number, command in commands(page):
                if "$DATA" in command:
                    if test_data() is None:
                        print(f"skipped: {page.name}:{number} needs the real test files")
                        continue
                    environment["DATA"] = str(test_data())
                with self.subTest(page=page.name, line=number, command=command):
                    done = subprocess.run(["bash", "-euc", command], cwd=folder, env=environment, capture_output=True,
                                          text=True, timeout=300)
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                    ran += 1
        self.assertGreater(ran, 10, "the documents have lost their examples")

    def test_help_of_every_command_is_complete(self):
        """Each command named in the table of docs/commands.md has a --help that exits 0 and says something of its own."""
        page = (SOURCE / "docs" / "commands.md").read_text()
        names = re.findall(r"^## `footwall ([a-z ]+)`", page, re.MULTILINE)
        self.assertGreater(len(names), 12)
        for name in names:
            done = subprocess.run([str(BIN / "footwall"), *name.split(), "--help"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, name)
            # Every option that the page names is one that the command has, and the other way round.
            section = page.split(f"## `footwall {name}`", 1)[1].split("\n## ", 1)[0]
            documented = set(re.findall(r"`(--[a-z0-9-]+)", section))
            offered = set(re.findall(r"(--[a-z0-9-]+)", done.stdout)) - {"--help", "--json", "--quiet"}
            self.assertEqual(documented - {"--json", "--quiet"}, offered, f"options of footwall {name}")

    def test_every_name_of_extract_is_explained(self):
        """Each name that `extract --help` lists (a row of a registry) stands between backticks in the page of its family."""
        words = subprocess.run([str(BIN / "footwall"), "extract", "--help"], capture_output=True, text=True).stdout
        for option, pages in (("--balance", ["balancing.md"]), ("--exchange", ["exchange-strategies.md"]),
                              ("--voxelizer", ["voxelizers.md"]), ("--compute", ["statistics.md", "lapped-transform.md"])):
            text = "".join((SOURCE / "docs" / page).read_text() for page in pages)
            said = {word for code in re.findall(r"`([^`\n]+)`", text) for word in re.findall(r"[a-z]+", code)}
            names = re.search(rf"{option} TEXT[^:]*: ([a-z, ]+) \(", words).group(1).split(", ")
            self.assertGreater(len(names), 2, option)
            self.assertEqual(set(names) - said, set(), f"names of {option} that none of {pages} explains")


if __name__ == "__main__":
    unittest.main()

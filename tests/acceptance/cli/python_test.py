"""The Python package: every ```python block of its page, its arrays against the command line's, its installation."""
import csv
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from support import BIN, SOURCE, FootwallTest

PACKAGE = BIN.parent / "python"
sys.path.insert(0, str(PACKAGE))
os.environ["FOOTWALL_PROGRAM"] = str(BIN / "footwall")

import numpy  # noqa: E402

import footwall  # noqa: E402


class Page(FootwallTest):
    def test_every_script_runs(self):
        """In the page's order, in one folder, each as its own program."""
        page = (SOURCE / "docs" / "python.md").read_text(encoding="utf-8")
        blocks = re.findall(r"^```(console|python)\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
        self.assertGreater(sum(kind == "python" for kind, _ in blocks), 3, "the page has lost its examples")
        environment = {**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}", "PYTHONPATH": str(PACKAGE)}
        for kind, text in blocks:
            if kind == "python":
                runs = [[sys.executable, "-B", "-W", "error", "-c", text]]
            else:
                runs = [["bash", "-euc", line[2:]] for line in text.splitlines() if line.startswith("$ ")]
            for words in runs:
                with self.subTest(script=text):
                    done = subprocess.run(words, cwd=self.folder, env=environment, capture_output=True, text=True,
                                          timeout=300)
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_installs_without_a_network(self):
        """Into a virtual environment of the system's Python, from the source alone."""
        made = subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", self.path("env")],
                              capture_output=True, text=True)
        if made.returncode != 0:
            self.skipTest("skipped: no python3-venv")
        # Building leaves files beside the source: a copy keeps the working tree clean.
        shutil.copytree(SOURCE / "app" / "python", self.path("tree/app/python"),
                        ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
        os.makedirs(self.path("tree/engine/service"))
        shutil.copy(SOURCE / "engine" / "service" / "engine.proto", self.path("tree/engine/service"))
        pip = subprocess.run([self.path("env/bin/pip"), "install", "--no-index", "--no-build-isolation", "--no-deps",
                              "--disable-pip-version-check", self.path("tree/app/python")], capture_output=True, text=True)
        self.assertEqual(pip.returncode, 0, pip.stdout + pip.stderr)
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        done = subprocess.run([self.path("env/bin/python"), "-c", "import footwall; print(footwall.Engine.__name__,"
                               " footwall.__file__)"], cwd=tempfile.gettempdir(), env=environment, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.split()[0], "Engine")
        self.assertIn(self.path("env"), done.stdout)


class Project(FootwallTest):
    def setUp(self):
        super().setUp()
        self.project = footwall.open(self.path(self.synthetic()))

    def assert_error(self, code, call, *arguments, **named):
        with self.assertRaises(footwall.Error) as caught:
            call(*arguments, **named)
        self.assertEqual(caught.exception.code, code, caught.exception)
        return caught.exception

    def test_index_and_world_are_inverse_and_agree_with_the_program(self):
        survey = self.project.survey
        nodes = self.project.nodes()
        world = numpy.stack([nodes["x"], nodes["y"], nodes["z"]], axis=1)
        index = survey.index_of(world)
        numpy.testing.assert_allclose(survey.world_of(index), world, rtol=0, atol=1e-6)
        told = [(node["inline"], node["crossline"]) for fault in self.footwall("faults", self.project.path)["faults"]
                for pillar in fault["pillars"] for node in pillar["nodes"]]
        numpy.testing.assert_allclose(survey.line_of(index)[:, :2], told, rtol=0, atol=1e-6)

    def test_sections_are_the_volume(self):
        self.footwall("export", self.project.path, "--raw", "whole")
        whole = numpy.fromfile(self.path("whole"), "<f4").reshape(self.project.survey.shape)
        survey = self.project.survey
        numpy.testing.assert_array_equal(self.project.section(inline=survey.inlines.first), whole[0])
        numpy.testing.assert_array_equal(self.project.section(crossline="last"), whole[:, -1])
        for sample in (0, 7, survey.samples - 1):
            numpy.testing.assert_array_equal(self.project.section(sample=sample), whole[:, :, sample])
        self.assert_error("invalid", self.project.section, sample=survey.samples)
        self.assert_error("usage", self.project.section)

    def test_edits_are_steps_and_say_what_fails(self):
        faults = self.project.faults()
        with self.project.edit() as edit:
            fault = edit.add_fault("made here, \"quoted\"")
            pillar, nodes = edit.add_pillar(fault, numpy.arange(6.0).reshape(2, 3))
            middle = edit.add_node(pillar, [9, 9, 2.5], at=1)
            self.assert_error("invalid", edit.move_node, middle, [numpy.nan, 0, 0])
            error = self.assert_error("not_found", edit.delete_pillar, 987654)
            self.assertIn("987654", error.message)
            edit.move_pillar(pillar, [1, 1, 1])  # goes on after a refusal
            held = self.start("edit", self.project.path, stdin='{"op":"add","what":"fault","name":"X"}')
            self.assertEqual(held.returncode, 1)
            self.assertIn("held", held.stdout)
            self.assertRegex(held.stderr, r"\d+")  # the process that holds it
        known = self.project.nodes(fault="made here, \"quoted\"")
        self.assertEqual(known["node"].tolist(), [nodes[0], middle, nodes[1]])
        self.assertEqual(known["z"].tolist(), [3, 3.5, 6])
        for _ in range(4):
            self.project.undo()
        self.assertEqual(self.project.faults().tolist(), faults.tolist())

    def test_statistics_are_those_of_the_table(self):
        self.project.extract(compute=["count", "mean", "contrast"])
        faces = self.project.statistics()
        self.footwall("faces", self.project.path, "--csv", "faces.csv")
        with open(self.path("faces.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(faces.ids.tolist(), [row["face"] for row in rows])
        self.assertEqual(faces.fault.tolist(), [row["fault"] for row in rows])
        for name in ("count", "mean", "contrast", "dip"):
            told = [float(row[name] or "nan") for row in rows]
            numpy.testing.assert_array_equal(faces.values[name], told, name)
        self.assertEqual(faces.corners[:, 2, 1].tolist(), [float(row["y2"]) for row in rows])
        present = self.project.faces(coordinates="index")
        self.assertEqual(present.values, {})
        numpy.testing.assert_array_equal(present.corners * 256, numpy.rint(present.corners * 256))
        self.assert_error("not_found", self.project.statistics, "no such run")

    def test_own_numbers_come_back(self):
        self.project.triangulate()
        faces = self.project.faces()
        wanted = numpy.where(numpy.arange(len(faces)) % 3 == 0, numpy.nan, numpy.arange(len(faces)) / 7)
        done = self.project.set_statistic("sevenths", wanted, unit="m", run="mine")
        self.assertEqual(done["undefined"], (len(faces) + 2) // 3)
        numpy.testing.assert_array_equal(self.project.statistics("mine").values["sevenths"], wanted)
        self.assertEqual(self.project.runs()["set_by_hand"].tolist(), ["sevenths"])
        self.assert_error("invalid", self.project.set_statistic, "sevenths", wanted[1:])
        self.assert_error("invalid", self.project.set_statistic, "variance", wanted)
        with self.project.edit() as edit:
            edit.move_node(self.project.nodes()["node"][0], self.project.survey.world_of([2, 2, 2]))
        self.assertTrue(self.project.statistics("mine").stale)

    def test_a_project_that_is_not_there(self):
        self.assert_error("not_found", footwall.open, self.path("none.footwall"))


if __name__ == "__main__":
    unittest.main()

"""The Python package with an engine of its own: the same numbers as the command line's, and nothing left behind."""
import os
import pathlib
import signal
import subprocess
import sys
import time
import unittest

from support import BIN, FootwallTest

PACKAGE = BIN.parent / "python"
sys.path.insert(0, str(PACKAGE))
os.environ["FOOTWALL_PROGRAM"] = str(BIN / "footwall")

import numpy  # noqa: E402

import footwall  # noqa: E402

SAME = ("count", "nulls", "outside", "mean", "variance", "min", "max", "discontinuity", "contrast")


def alive(process):
    """Whether it still runs; one that has ended and waits for its parent to look does not."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def wait_until(done, seconds=20):
    deadline = time.monotonic() + seconds
    while not done():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.05)
    return True


class PythonEngine(FootwallTest):
    def setUp(self):
        super().setUp()
        self.project = footwall.open(self.path(self.synthetic()))
        self.project.triangulate()

    def started(self, **how):
        engine = footwall.Engine.start(self.project, ranks=2, **how)
        self.addCleanup(engine.close)
        return engine

    def test_numbers_are_those_of_the_command_line(self):
        self.project.extract()
        told = self.project.statistics()
        engine = self.started()
        self.assertEqual(engine.status().ranks, 2)
        numbers = engine.extract()
        row = {name: n for n, name in enumerate(zip(numbers.faults.tolist(), numbers.ids.tolist()))}
        order = [row[engine.fault_number(fault), face] for fault, face in zip(told.fault.tolist(), told.ids.tolist())]
        self.assertEqual(len(order), len(numbers))
        for name in SAME:
            numpy.testing.assert_array_equal(numbers[name][order].astype(float), told.values[name], name)
        # Nothing changed since: nothing to do.
        self.assertEqual(len(engine.extract(changed_only=True)), 0)

    def test_voxels_and_sections_are_the_volume(self):
        self.footwall("export", self.project.path, "--raw", "whole")
        whole = numpy.fromfile(self.path("whole"), "<f4").reshape(self.project.survey.shape)
        engine = self.started()
        numbers = engine.extract(compute=["count", "mean"])
        face = int(numpy.argmax(numbers["count"]))
        indices, values = engine.voxels((int(numbers.faults[face]), str(numbers.ids[face])))
        self.assertEqual(len(values), numbers["count"][face])
        numpy.testing.assert_array_equal(values, whole[tuple(indices.T)])
        self.assertAlmostEqual(values.astype(float).mean(), numbers["mean"][face], places=9)
        numpy.testing.assert_array_equal(engine.section(inline="last"), whole[-1])
        numpy.testing.assert_array_equal(engine.section(sample=5), whole[:, :, 5])
        numpy.testing.assert_array_equal(engine.box(None, (3, 4, 5), (9, 9, 9)), whole[3:9, 4:9, 5:9])

    def test_pillars_give_what_the_project_stores(self):
        engine = self.started()
        for fault in self.project.faults()["name"].tolist():
            made = engine.triangulate(fault)
            stored = self.project.faces(fault, coordinates="index")
            self.assertGreater(len(made.faces), 0)
            row = {name: n for n, name in enumerate(made.faces.ids.tolist())}
            order = [row[name] for name in stored.ids.tolist()]
            self.assertEqual(len(order), len(made.faces))
            numpy.testing.assert_array_equal(made.faces.corners[order], stored.corners)
            self.assertEqual(set(made.faces.faults.tolist()), {engine.fault_number(fault)})
            numpy.testing.assert_allclose(self.project.survey.index_of(made.vertices[made.triangles]), made.faces.corners,
                                          atol=1 / 256)
        between = engine.interpolate("planar", every=2)
        self.assertGreater(len(between), 0)
        before = set(self.project.pillars("planar")["pillar"].tolist())
        self.project.interpolate("planar", every=2)
        nodes = self.project.nodes("planar")
        added = [pillar for pillar in self.project.pillars("planar") if pillar["pillar"] not in before]
        self.assertEqual([(each.first, each.second) for each in between], [tuple(pillar["parents"]) for pillar in added])
        for each, pillar in zip(between, added):
            stored = nodes[nodes["pillar"] == pillar["pillar"]]
            numpy.testing.assert_allclose(each.nodes, numpy.stack([stored[name] for name in "xyz"], axis=1), rtol=1e-12)
        self.assertEqual(len(engine.interpolate("planar", every=2)), len(between))  # of those that were picked, still
        # Pillars of no project.
        survey = self.project.survey
        slope = {n: survey.world_of([[5, j, 4], [9, j, 20]]) for n, j in ((1, 5), (2, 15), (3, 25))}
        flat = engine.interpolate(slope, every=5)
        self.assertEqual([(each.first, each.second, each.parameter) for each in flat], [(1, 2, 0.5), (2, 3, 0.5)])
        for each, j in zip(flat, (10, 20)):
            numpy.testing.assert_allclose(survey.index_of(each.nodes), [[5, j, 4], [9, j, 20]], atol=1e-6)
        self.assertGreater(len(engine.triangulate(slope).triangles), 0)
        for wrong in (lambda: engine.interpolate("planar"), lambda: engine.triangulate("nobody")):
            with self.assertRaises(footwall.Error):
                wrong()

    def test_a_volume_that_covers_a_part_of_the_survey(self):
        """The model stays where it is: the numbers are those of the command line, voxels are the survey's."""
        survey = self.project.survey
        self.footwall("export", self.project.path, "--raw", "whole")
        whole = numpy.fromfile(self.path("whole"), "<f4").reshape(survey.shape)
        lines = [f"{axis.first + 5 * axis.step}:{axis.first + 29 * axis.step}" for axis in (survey.inlines, survey.crosslines)]
        self.footwall("import", "volume", self.project.path, "whole", "--raw", "--dims", "x".join(map(str, survey.shape)),
                      "--domain", survey.domain, "--vertical-unit", survey.vertical_unit, "--interval", survey.interval,
                      "--name", "part", "--inlines", lines[0], "--crosslines", lines[1],
                      "--z", f"{survey.z0 + 4 * survey.interval}:")
        self.assertEqual(self.project.volume("part")["origin"], [5, 5, 4])
        own = self.project.extract(volume="part")
        told = self.project.statistics()
        engine = self.started()
        self.assertEqual(len(engine.status().volumes), 2)
        numbers = engine.extract("part")
        row = {name: n for n, name in enumerate(zip(numbers.faults.tolist(), numbers.ids.tolist()))}
        order = [row[engine.fault_number(fault), face] for fault, face in zip(told.fault.tolist(), told.ids.tolist())]
        self.assertGreater(numbers["count"].max(), 0)
        self.assertGreater(numbers["outside"].max(), 0)
        for name in SAME:
            numpy.testing.assert_array_equal(numbers[name][order].astype(float), told.values[name], name)
        face = int(numpy.argmax(numbers["count"]))
        indices, values = engine.voxels((int(numbers.faults[face]), str(numbers.ids[face])), "part")
        numpy.testing.assert_array_equal(values, whole[tuple(indices.T)])
        engine.extract()  # of the whole, beside it
        self.assertEqual(len(engine.extract("part", changed_only=True)), 0)
        job = self.footwall("extract", self.project.path, "--volume", "part", "--engine", f"@{engine._file}")
        self.assertEqual(job["checksum"], own["checksum"])

    def test_live_numbers_are_those_of_a_whole_extraction(self):
        engine = self.started()
        fault = str(self.project.faults()["name"][0])
        with engine.live(compute=["count", "mean", "variance"]) as live:
            mesh = live.mesh(fault)
            vertex = int(mesh.triangles[len(mesh.triangles) // 2, 0])
            before = mesh.vertices[vertex].copy()
            for step in range(20):  # as a hand drags
                last = live.move(fault, vertex, before + [0.1 * step, 0, 0])
            answer = live.wait(last)
            touched = mesh.faces[(mesh.triangles == vertex).any(axis=1)]
        self.assertEqual(answer.edit, last)
        self.assertEqual(sorted(answer.ids.tolist()), sorted(touched.ids.tolist()))
        whole = engine.extract(compute=["count", "mean", "variance"])
        row = {name: n for n, name in enumerate(zip(whole.faults.tolist(), whole.ids.tolist()))}
        order = [row[name] for name in zip(answer.faults.tolist(), answer.ids.tolist())]
        for name in ("count", "mean", "variance"):
            numpy.testing.assert_array_equal(answer[name], whole[name][order], name)
        # Back to what the project has.
        engine.load_model(fault)
        held = engine.model(fault)
        self.assertTrue((held.corners == before).all(axis=2).any())

    def test_moves_outlive_the_engine(self):
        """Whichever of its processes is killed in the middle of a stream of moves."""
        fault = str(self.project.faults()["name"][0])
        for kind in ("rank 0", "rank 1", "serve"):
            with self.subTest(kind=kind):
                engine = self.started()
                status = engine.status()
                victim = {"rank 0": status.process, "rank 1": status.each_rank[1].process,
                          "serve": engine._served._process.pid}[kind]
                told = {}
                with engine.live(compute=["count", "mean"]) as live:
                    mesh = live.mesh(fault)
                    for step in range(60):
                        vertex = step % len(mesh.vertices)
                        last = live.move(fault, vertex, mesh.vertices[vertex] + [0.25, 0, 0])
                        if step == 30:
                            os.kill(victim, signal.SIGKILL)
                    while True:
                        answer = live.numbers(60)
                        for name, count, mean in zip(answer.ids.tolist(), answer["count"], answer["mean"]):
                            told[name] = (count, mean)
                        if answer.edit >= last:
                            break
                self.assertNotEqual(engine.status().process, status.process)
                whole = engine.extract(compute=["count", "mean"])
                of_fault = whole.faults == engine.fault_number(fault)
                found = {name: numbers for name, *numbers in zip(whole.ids[of_fault].tolist(), whole["count"][of_fault],
                                                                 whole["mean"][of_fault])}
                self.assertEqual(len(told), len(mesh.faces))
                for name, numbers in told.items():
                    numpy.testing.assert_array_equal(found[name], numbers, name)
                self.assertEqual(engine.section(sample=5).shape, self.project.survey.shape[:2])
                engine.close()

    def test_isosurfaces_and_pictures(self):
        engine = self.started()
        told = self.footwall("isosurface", self.project.path, "--value", "0.5")
        vertices, normals, triangles = engine.isosurface(0.5)
        self.assertEqual((len(vertices), len(triangles)), (told["vertices"], told["triangles"]))
        numpy.testing.assert_allclose(numpy.linalg.norm(normals, axis=1), 1, atol=1e-3)
        camera = footwall.Camera(azimuth=40, elevation=30)
        rgba, depth = engine.render(camera, [(None, 0.5, (200, 160, 60))], (960, 720))
        view = camera.view(self.project.survey, 960, 720)
        clip = numpy.c_[view.scene.of_index(vertices), numpy.ones(len(vertices))] @ view.matrix.T
        at = clip[:, :3] / clip[:, 3:]
        column = numpy.floor((at[:, 0] + 1) / 2 * 960).astype(int)
        row = numpy.floor((1 - at[:, 1]) / 2 * 720).astype(int)
        inside = (column >= 2) & (column < 958) & (row >= 2) & (row < 718)
        self.assertGreater(inside.mean(), 0.99)
        # Nothing lies before what is seen, of the pixels around it: at an edge its own pixel may be empty, and a
        # sliver seen from its side may have none.
        windows = numpy.lib.stride_tricks.sliding_window_view(numpy.pad(depth, 1, constant_values=1), (3, 3))
        nearest = windows.min(axis=(2, 3))[row[inside], column[inside]]
        behind = (at[inside, 2] + 1) / 2 - nearest
        self.assertGreater((behind > -1e-3).mean(), 0.99, "vertices lie before the picture")
        self.assertGreater((numpy.abs(behind) < 5e-3).mean(), 0.05, "no vertex is seen")
        numpy.testing.assert_array_equal(depth < 1, rgba[..., 3] > 0)
        again = engine.render(camera, [(None, 0.5, (200, 160, 60))], (960, 720), visible=True)
        numpy.testing.assert_array_equal(again[0], rgba)
        numpy.testing.assert_array_equal(again[1], depth)

    def test_an_engine_ends_with_its_script(self):
        """Also where the script had no time to end it."""
        for how in ("sys.exit()", "os.kill(os.getpid(), signal.SIGKILL)"):
            script = ("import os, signal, sys, footwall\n"
                      f"e = footwall.Engine.start({str(self.project.path)!r}, ranks=2)\n"
                      "s = e.status()\n"
                      "print(e._served._process.pid, s.process, *[r.process for r in s.each_rank], flush=True)\n" + how)
            environment = {**os.environ, "PYTHONPATH": str(PACKAGE)}
            done = subprocess.run([sys.executable, "-B", "-c", script], env=environment, capture_output=True, text=True,
                                  timeout=120)
            self.assertIn(done.returncode, (0, -signal.SIGKILL), done.stderr)
            processes = set(map(int, done.stdout.split()))
            self.assertGreaterEqual(len(processes), 2)
            self.assertTrue(wait_until(lambda: not any(map(alive, processes))), f"{how}: {processes} are left")


if __name__ == "__main__":
    unittest.main()

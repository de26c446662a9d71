"""The Python client of an engine, against a server whose answers are known."""
import json
import os
import sys
import time
import unittest

from support import BIN, FootwallTest

sys.path.insert(0, str(BIN.parent / "python"))
os.environ["FOOTWALL_PROGRAM"] = str(BIN / "footwall")

import numpy  # noqa: E402

import footwall  # noqa: E402
from fake_engine import TOKEN, FakeEngine, serve, voxel  # noqa: E402


class PythonClient(FootwallTest):
    def setUp(self):
        super().setUp()
        self.fake = FakeEngine()
        self.fake.faces = {(1, 5 << 31 | 6, 0): [0, 0, 0, 256, 0, 0, 0, 256, 0],
                           (1, 5 << 31 | 6, 1): [256, 0, 0, 256, 256, 0, 0, 256, 0],
                           (2, 9, 4): [0, 0, 512, 256, 0, 512, 0, 256, 512]}
        address = "unix:" + self.path("socket")
        self.server = serve(self.fake, address)
        self.addCleanup(lambda: self.server.stop(None).wait())
        self.file = self.connection_file("engine.json", address)

    def connection_file(self, name, address, token=TOKEN, mode=0o600):
        file = self.path(name)
        with open(file, "w", encoding="utf-8") as out:
            json.dump({"footwall_engine": 1, "address": address, "token": token, "certificate": "", "fingerprint": "",
                       "host": "elsewhere", "process": 1, "version": "0", "project": ""}, out)
        os.chmod(file, mode)
        return "@" + file

    def connected(self, project=None):
        engine = footwall.Engine.connect(self.file, project)
        self.addCleanup(engine.close)
        return engine

    def assert_error(self, code, words, call, *arguments, **named):
        with self.assertRaises(footwall.Error) as caught:
            call(*arguments, **named)
        self.assertEqual(caught.exception.code, code, caught.exception)
        self.assertIn(words, caught.exception.message)
        return caught.exception

    def test_connection_files_of_others_are_refused(self):
        connect = footwall.Engine.connect
        self.assert_error("not_found", "no engine runs", connect, "@" + self.path("none"))
        open_to_all = self.connection_file("open.json", "unix:x", mode=0o644)
        self.assert_error("invalid", "by others", connect, open_to_all)
        with open(self.path("wrong.json"), "w", encoding="utf-8") as out:
            out.write('{"footwall_engine": 1, "address": 5, "token": "x"}')
        os.chmod(self.path("wrong.json"), 0o600)
        self.assert_error("format", "not the connection file", connect, "@" + self.path("wrong.json"))
        wrong_token = self.connection_file("token.json", "unix:" + self.path("socket"), token="wrong" * 8)
        self.assert_error("invalid", "token", connect, wrong_token)
        self.assert_error("usage", "no token", connect, "unix:" + self.path("socket"))

    def test_a_dead_engine_is_told_soon(self):
        engine = self.connected()
        self.server.stop(None).wait()
        begun = time.monotonic()
        error = self.assert_error("engine", "has ended", engine.status)
        self.assertLess(time.monotonic() - begun, 10)
        self.assertIn("elsewhere", error.hint)

    def test_extract_joins_pieces_and_says_what_fails(self):
        engine = self.connected()
        phases = []
        numbers = engine.extract("cafe", ["mean"], progress=lambda fraction, phase, amounts: phases.append(phase))
        self.assertEqual(self.fake.requests[0].options.compute, ["mean"])
        self.assertEqual(numbers.ids.tolist(), ["5-6.0", "5-6.1", "9.4"])
        self.assertEqual(numbers.faults.tolist(), [1, 1, 2])
        self.assertEqual(numbers["mean"].tolist(), [512, 1024, 2048])
        self.assertEqual(set(numbers.values), {"count", "mean"})
        self.assertEqual((numbers.edit, phases), (7, ["compute"]))
        error = self.assert_error("not_found", "no volume beef", engine.extract, "beef")
        self.assertEqual(error.hint, "open one")

    def test_an_exception_in_progress_cancels_the_call(self):
        engine = self.connected()
        self.fake.hold.clear()

        def stop(*_):
            raise KeyboardInterrupt
        with self.assertRaises(KeyboardInterrupt):
            engine.extract("cafe", progress=stop)
        self.assertTrue(self.fake.left.wait(10), "the engine was not told that nobody listens")

    def test_a_call_that_the_engine_leaves_was_not_cancelled_by_the_user(self):
        engine = self.connected()
        self.fake.ends = True
        error = self.assert_error("engine", "the engine ends", engine.extract, "cafe")
        self.assertIn("footwall serve", error.hint)

    def test_live_moves_send_the_touched_faces_and_bring_their_numbers(self):
        engine = self.connected()
        with engine.live("cafe", ["mean"]) as live:
            mesh = live.mesh(1)
            self.assertEqual((mesh.vertices.shape, len(mesh.faces)), ((4, 3), 2))
            vertex = numpy.nonzero((mesh.vertices == [1, 1, 0]).all(axis=1))[0][0]
            first = live.move(1, vertex, (1.5, 1, 0))
            answer = live.wait(first)
            self.assertEqual((answer.edit, answer.ids.tolist()), (first, ["5-6.1"]))
            self.assertEqual(answer["mean"].tolist(), [1024 + 128])
            # The move is known to the next one: a vertex of both faces.
            corner = numpy.nonzero((mesh.vertices == [0, 1, 0]).all(axis=1))[0][0]
            second = live.move(1, corner, (0, 1.25, 0))
            answer = live.wait(second)
            self.assertGreater(second, first)
            self.assertEqual(answer["mean"].tolist(), [512 + 64, 1024 + 128 + 64])
            gone = live.wait(live.remove(engine.model(2)))
            self.assertEqual([part.tolist() for part in gone.removed], [[2], [9], [4]])
            live.wait(live.remove(live.mesh(1).faces))
            live.remove(live.mesh(1).faces)
            self.assert_error("not_found", "no such face", live.numbers)
        self.assertEqual([batch.edit for batch in self.fake.batches], list(range(8, 8 + len(self.fake.batches))))

    def test_voxels_by_corners_and_by_name(self):
        engine = self.connected()
        indices, values = engine.voxels([[0, 0, 0], [1, 0.5, 0], [0, 1, 1 / 256]], "cafe")
        self.assertEqual(list(self.fake.requests[0].corners), [0, 0, 0, 256, 128, 0, 0, 256, 1])
        self.assertEqual(indices.tolist(), [[1, 2, 3], [1, 2, 4], [1, 2, 5]])
        numpy.testing.assert_array_equal(values, numpy.array([4.5, numpy.nan, 6.5], "f4"))
        engine.voxels((2, "9.4"), "cafe")
        self.assertEqual(list(self.fake.requests[1].corners), self.fake.faces[(2, 9, 4)])
        self.assert_error("not_found", "no face 9.5", engine.voxels, (2, "9.5"), "cafe")

    def test_boxes_and_sections(self):
        project = footwall.open(self.path(self.synthetic(size="40x36x32")))
        engine = self.connected(project)
        survey = project.survey
        i, j, k = numpy.meshgrid(numpy.arange(40), numpy.arange(36), numpy.arange(32), indexing="ij")
        whole = voxel(i, j, k)
        numpy.testing.assert_array_equal(engine.box(None, (0, 0, 0), (3, 4, 5)), whole[:3, :4, :5])
        numpy.testing.assert_array_equal(engine.section(inline=survey.inlines.last), whole[-1])
        numpy.testing.assert_array_equal(engine.section(crossline="middle"), whole[:, 18])
        numpy.testing.assert_array_equal(engine.section(sample=31), whole[:, :, 31])
        numpy.testing.assert_array_equal(engine.section(z=survey.z0 + 2 * survey.interval), whole[:, :, 2])
        self.assert_error("invalid", "no inline", engine.section, inline=survey.inlines.last + 1)
        self.assert_error("usage", "one plane", engine.section, inline=1, z=2)

    def test_isosurfaces_are_joined(self):
        vertices, normals, triangles = self.connected().isosurface(0.5, "cafe")
        self.assertEqual((vertices.shape, normals.shape), ((4, 3), (4, 3)))
        self.assertEqual(triangles.tolist(), [[0, 1, 2], [1, 3, 2]])
        self.assertIsNone(self.connected().isosurface(0.5, "cafe", normals=False)[1])

    def test_pictures(self):
        project = footwall.open(self.path(self.synthetic()))
        engine = self.connected(project)
        rgba, depth = engine.render(footwall.Camera(40, 30), [(None, 0.5, (255, 128, 0))], (8, 6), visible=True)
        self.assertEqual((rgba.shape, depth.shape), ((6, 8, 4), (6, 8)))
        self.assertEqual(rgba[1:3].reshape(-1, 4).tolist(), [[1, 2, 3, 4]] * 16)
        self.assertEqual((rgba[0].max(), rgba[3:].max(), depth[0, 0], depth[2, 7]), (0, 0, 1, 0.25))
        request = self.fake.requests[0]
        self.assertEqual(request.isosurfaces[0].colour, 0xFF0080FF)
        self.assertEqual(request.isosurfaces[0].volume, project.volume()["checksum"])
        self.assertTrue(request.HasField("visible"))
        # The survey's centre comes to the middle of the scene, and its box to the middle of the picture.
        linear = numpy.array(request.isosurfaces[0].placement.linear).reshape(3, 3)
        centre = linear @ ((numpy.array(project.survey.shape) - 1) / 2) + request.isosurfaces[0].placement.shift
        numpy.testing.assert_allclose(centre, 0, atol=1e-6)
        self.fake.bad_tile = True
        self.assert_error("engine", "rows", engine.render, footwall.Camera(), [(None, 0.5, (1, 2, 3))], (8, 6))

    def test_the_model_is_put_in_place(self):
        project = footwall.open(self.path(self.synthetic()))
        project.triangulate()
        engine = self.connected(project)
        self.fake.faces = {}
        engine.load_model()
        faces = project.faces(coordinates="index")
        model = engine.model()
        self.assertEqual(len(model), len(faces))
        self.assertEqual(sorted(model.ids.tolist()), sorted(faces.ids.tolist()))
        fault = faces.fault[0]
        rows = faces.fault == fault
        held = engine.model(str(fault))
        order = {name: row for row, name in enumerate(held.ids.tolist())}
        numpy.testing.assert_array_equal(held.corners[[order[name] for name in faces.ids[rows].tolist()]],
                                         faces.corners[rows])


if __name__ == "__main__":
    unittest.main()

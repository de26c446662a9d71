"""Volumes in and out: parts and other grids, raw, NRRD, SEG-Y and VTI, through the programs."""
import array
import json
import pathlib
import subprocess
import sys
import unittest

from support import FootwallTest

TIME = ("--domain", "time", "--vertical-unit", "ms")


def floats(path):
    values = array.array("f")
    values.frombytes(pathlib.Path(path).read_bytes())
    return values


class Volumes(FootwallTest):
    """A volume of 6 x 5 x 8 samples whose value tells where it is: 100 i + 10 j + k."""
    DIMS = (6, 5, 8)

    def setUp(self):
        super().setUp()
        values = array.array("f", [self.value(i, j, k) for i in range(6) for j in range(5) for k in range(8)])
        pathlib.Path(self.path("v.raw")).write_bytes(values.tobytes())

    @staticmethod
    def value(i, j, k):
        return 100 * i + 10 * j + k

    def project(self, name="p.footwall", *more):
        return self.footwall("new", name, "--raw", "v.raw", "--dims", "6x5x8", *TIME, "--interval", 4, *more)

    def samples(self, project, volume=""):
        self.footwall("export", project, "--raw", "out.raw", *(("--volume", volume) if volume else ()))
        return floats(self.path("out.raw"))

    def geometry(self, project):
        survey = self.footwall("info", project)["survey"]
        return {key: survey[key] for key in ("inlines", "crosslines", "samples", "interval", "z0")}

    def test_every_import_reports(self):
        report = self.project()
        self.assertEqual((report["read"], report["skipped"], report["rejected"], report["renamed"]), (30, 0, [], []))
        self.assertTrue(any("numbered from 1" in line for line in report["assumed"]))
        self.assertEqual(report["warnings"], [])

    def test_all_options_that_are_missing_are_named_at_once(self):
        means = {"--dims": "its size", "--domain": "time or depth", "--vertical-unit": "the unit of z",
                 "--interval": "the sample interval"}
        values = {"--dims": "6x5x8", "--domain": "time", "--vertical-unit": "ms", "--interval": "4"}

        def check(names, *command):
            error = self.refused(2, *command)
            for name, meaning in means.items():
                self.assertEqual(name in error["message"], name in names, error)
                self.assertEqual(name in error["hint"], name in names, error)
                self.assertEqual(meaning in error["message"], name in names, error)

        for given in range(4):
            told = [word for name in list(means)[:given] for word in (name, values[name])]
            check(list(means)[given:], "new", "x.footwall", "--raw", "v.raw", *told)
        check(["--domain"], "new", "x.footwall", "--raw", "v.raw", "--dims", "6x5x8", "--vertical-unit", "ms", "--interval", 4)
        self.assertFalse(pathlib.Path(self.path("x.footwall")).exists())
        self.footwall("new", "empty.footwall")
        check(list(means), "import", "volume", "empty.footwall", "v.raw", "--raw")

        self.project()
        check(["--dims"], "import", "volume", "p.footwall", "v.raw", "--raw")  # the survey tells the rest
        self.footwall("export", "p.footwall", "--segy", "v.sgy")
        pathlib.Path(self.path("v.nrrd")).write_bytes(
            b"NRRD0004\ntype: float\ndimension: 3\nsizes: 8 5 6\nencoding: raw\nendian: little\n\n"
            + pathlib.Path(self.path("v.raw")).read_bytes())
        for file in ("v.sgy", "v.nrrd"):
            check(["--domain", "--vertical-unit"], "import", "volume", "empty.footwall", file)
            check(["--vertical-unit"], "import", "volume", "empty.footwall", file, "--domain", "time")

    def test_one_time_slice_comes_back_from_nrrd_as_one(self):
        self.project("s.footwall", "--z", "8")
        before = self.footwall("info", "s.footwall")
        self.footwall("export", "s.footwall", "--nrrd", "s.nrrd")
        self.footwall("new", "t.footwall", "--nrrd", "s.nrrd")
        after = self.footwall("info", "t.footwall")
        self.assertEqual(after["volumes"][0]["checksum"], before["volumes"][0]["checksum"])
        for key in ("inlines", "crosslines", "samples", "interval", "z0", "map"):
            self.assertEqual(after["survey"][key], before["survey"][key])

    def test_crop_takes_line_numbers_and_z(self):
        report = self.project("c.footwall", "--inlines", "2:6:2", "--crosslines", "3:99", "--z", "8:20")
        self.assertEqual(report["dims"], [3, 3, 4])
        self.assertIn("clipped", report["warnings"][0])
        wanted = [self.value(i, j, k) for i in (1, 3, 5) for j in (2, 3, 4) for k in (2, 3, 4, 5)]
        self.assertEqual(list(self.samples("c.footwall")), wanted)
        geometry = self.geometry("c.footwall")
        self.assertEqual(geometry["inlines"], {"first": 2, "last": 6, "step": 2, "count": 3})
        self.assertEqual((geometry["z0"], geometry["samples"]), (8, 4))

    def test_crop_of_a_later_volume_lies_in_the_survey(self):
        self.project()
        raw = ("import", "volume", "p.footwall", "v.raw", "--raw", "--dims", "6x5x8")
        self.footwall(*raw, "--name", "part", "--inlines", "3:5", "--z", "12:")
        self.assertEqual(list(self.samples("p.footwall", "part")),
                         [self.value(i, j, k) for i in (2, 3, 4) for j in range(5) for k in range(3, 8)])
        error = self.refused(1, *raw, "--name", "coarse", "--inlines", "1:6:2")
        self.assertIn("--resample survey", error["hint"])
        # ... which brings it back onto the grid, exactly, since the field is linear.
        self.footwall(*raw, "--name", "back", "--inlines", "1:5:2", "--z", "0:24:8", "--resample", "survey")
        for got, want in zip(self.samples("p.footwall", "back"),
                             [self.value(i, j, k) for i in range(5) for j in range(5) for k in range(7)], strict=True):
            self.assertAlmostEqual(got, want, places=3)

    def test_refusals_of_ranges_name_the_files(self):
        error = self.refused(1, "new", "n.footwall", "--raw", "v.raw", "--dims", "6x5x8", *TIME, "--interval", 4,
                             "--inlines", "7:9")
        self.assertIn("1 to 6 by 1", error["message"])
        for wrong in (("--inlines", "a:b"), ("--inlines", "5:2"), ("--z", "0:20:6"), ("--crosslines", "1:2:3:4"),
                      ("--resample", "6x5"), ("--resample", "survey")):
            self.refused(2, "new", "n.footwall", "--raw", "v.raw", "--dims", "6x5x8", *TIME, "--interval", 4, *wrong)
        self.assertFalse(pathlib.Path(self.path("n.footwall")).exists())

    def test_resample_over_the_same_extent(self):
        report = self.project("r.footwall", "--resample", "11x9x15")
        self.assertEqual(report["dims"], [11, 9, 15])
        for n, got in enumerate(self.samples("r.footwall")):
            i, j, k = n // 135, n // 15 % 9, n % 15
            self.assertAlmostEqual(got, self.value(i / 2, j / 2, k / 2), places=3)
        self.assertEqual(self.geometry("r.footwall")["interval"], 2)

    def test_options_that_contradict_the_survey(self):
        self.project()
        raw = ("import", "volume", "p.footwall", "v.raw", "--raw", "--dims", "6x5x8", "--name", "n")
        self.assertIn("the project's survey has 4", self.refused(1, *raw, "--interval", 2)["message"])
        self.assertIn("--domain", self.refused(1, *raw, "--domain", "depth")["message"])
        self.assertIn("--vertical-unit", self.refused(1, *raw, "--vertical-unit", "m")["message"])
        self.footwall(*raw, "--interval", 4, "--domain", "time")

    def test_raw_in_every_order(self):
        self.project()
        for axes in ("kji", "jik"):
            for endian in ("little", "big"):
                self.footwall("export", "p.footwall", "--raw", "o.raw", "--axes", axes, "--endian", endian)
                self.footwall("import", "volume", "p.footwall", "o.raw", "--raw", "--dims", "6x5x8", "--axes", axes,
                              "--endian", endian, "--name", axes + endian)
                self.assertEqual(self.samples("p.footwall", axes + endian), floats(self.path("v.raw")))
        self.footwall("export", "p.footwall", "--raw", "o.raw", "--axes", "kji")
        self.assertEqual(list(floats(self.path("o.raw"))[:7]), [0, 100, 200, 300, 400, 500, 10])

    def test_nrrd_out_and_in_is_the_identity(self):
        self.project("p.footwall", "--crs", "EPSG:23031", "--inlines", "2:6:2")
        self.footwall("export", "p.footwall", "--nrrd", "o.nrrd")
        told = self.footwall("info", "o.nrrd")
        self.assertEqual((told["type"], [axis["size"] for axis in told["axes"]]), ("float", [3, 5, 8]))
        again = self.footwall("new", "q.footwall", "--nrrd", "o.nrrd", "--name", "same")
        self.assertEqual(again["assumed"], [])
        self.assertEqual(self.geometry("q.footwall"), self.geometry("p.footwall"))
        self.assertEqual(self.footwall("info", "q.footwall")["survey"]["crs"], "EPSG:23031")
        self.assertEqual(self.samples("q.footwall"), self.samples("p.footwall"))
        self.footwall("import", "volume", "p.footwall", "o.nrrd", "--name", "placed")
        self.refused(1, "import", "volume", "p.footwall", "o.nrrd", "--name", "n", "--interval", 3)
        self.refused(1, "import", "volume", "p.footwall", "o.nrrd", "--name", "n", "--domain", "depth", "--vertical-unit", "m")

    def test_nrrd_that_does_not_say_where_it_is(self):
        body = array.array("h", range(-20, 10 * 3 * 2 - 20)).tobytes()
        head = b"NRRD0004\r\ntype: short\r\nendian: little\r\ndimension: 3\r\nsizes: 10 3 2\r\nencoding: raw\r\n\r\n"
        pathlib.Path(self.path("n.nrrd")).write_bytes(head + body)
        self.assertIn("--domain", self.refused(2, "new", "n.footwall", "--nrrd", "n.nrrd")["message"])
        report = self.footwall("new", "n.footwall", "--nrrd", "n.nrrd", *TIME, "--interval", 2)
        self.assertEqual((report["dims"], report["min"], report["max"]), ([10, 3, 2], -20, 39))
        self.assertTrue(any("no spacing" in line for line in report["assumed"]), report["assumed"])
        self.footwall("import", "volume", "n.footwall", "n.nrrd", "--name", "again")
        error = self.refused(1, "import", "volume", "n.footwall", "n.nrrd", "--name", "turned", "--axes", "ijk")
        self.assertIn("2x3x10", error["message"])

    def test_segy_out_and_in_is_the_identity(self):
        self.synthetic("s.footwall")
        for fmt, name in ((5, "ieee"), (1, "ibm")):
            answer = self.footwall("export", "s.footwall", "--segy", name + ".sgy", "--segy-format", fmt)
            self.assertEqual(answer["segy"]["traces"], 40 * 36)
            report = self.footwall("new", name + ".footwall", "--segy", name + ".sgy", *TIME)
            self.assertEqual(report["warnings"], [])
        self.assertEqual(self.samples("ieee.footwall"), self.samples("s.footwall"))
        for got, want in zip(self.samples("ibm.footwall"), self.samples("s.footwall"), strict=True):
            self.assertLessEqual(abs(got - want), abs(want) * 2 ** -21)
        self.assertEqual(self.geometry("ieee.footwall"), self.geometry("s.footwall"))
        # It lies on the survey it came from.
        self.footwall("import", "volume", "s.footwall", "ieee.sgy", *TIME, "--name", "again")
        told = self.footwall("info", "ieee.sgy")
        self.assertEqual((told["format"], told["revision"], told["live_traces"]), (5, "1.0", 1440))

    def test_segy_crop(self):
        self.synthetic("s.footwall")
        survey = self.footwall("info", "s.footwall")["survey"]
        first, step = survey["inlines"]["first"], survey["inlines"]["step"]
        self.footwall("export", "s.footwall", "--segy", "s.sgy")
        whole = self.samples("s.footwall")
        self.footwall("new", "c.footwall", "--segy", "s.sgy", *TIME, "--inlines",
                      f"{first + 4 * step}:{first + 12 * step}:{4 * step}", "--z",
                      f"{survey['z0'] + 5 * survey['interval']}:")
        wanted = [whole[(i * 36 + j) * 32 + k] for i in (4, 8, 12) for j in range(36) for k in range(5, 32)]
        self.assertEqual(list(self.samples("c.footwall")), wanted)

    def read_with_vtk(self, file, places):
        """Name, dims, vertical unit, and value and point at each place, as VTK itself reads them; None without VTK."""
        script = ("import json, sys\n"
                  "from vtkmodules.vtkIOXML import vtkXMLImageDataReader\n"
                  "reader = vtkXMLImageDataReader(); reader.SetFileName(sys.argv[1]); reader.Update()\n"
                  "image = reader.GetOutput(); values = image.GetPointData().GetScalars()\n"
                  "ids = [image.ComputePointId(place) for place in json.loads(sys.argv[2])]\n"
                  "print(json.dumps([values.GetName(), image.GetDimensions(),\n"
                  "  image.GetFieldData().GetAbstractArray('vertical_unit').GetValue(0),\n"
                  "  [[values.GetValue(n), image.GetPoint(n)] for n in ids]]))")
        for python in (sys.executable, "/usr/bin/python3"):  # VTK's bindings belong to the system's Python
            has = subprocess.run([python, "-c", "import vtkmodules.vtkIOXML"], capture_output=True)
            if has.returncode == 0:
                done = subprocess.run([python, "-c", script, self.path(file), json.dumps(places)],
                                      capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                return json.loads(done.stdout)
        return None

    def test_vti_as_vtk_reads_it(self):
        self.project()
        self.synthetic("s.footwall", size="12x10x8")
        self.footwall("export", "p.footwall", "--vti", "p.vti")
        self.footwall("export", "s.footwall", "--vti", "s.vti", "--nrrd", "s.nrrd")
        self.assertIn(b'WholeExtent="0 5 0 4 0 7"', pathlib.Path(self.path("p.vti")).read_bytes()[:2000])
        places = [[0, 0, 0], [5, 4, 7], [2, 3, 1]]
        answer = self.read_with_vtk("p.vti", places)
        if answer is None:
            self.skipTest("skipped: python3-vtk9 is not here to read it back")
        name, dims, unit, found = answer
        self.assertEqual((name, dims, unit), ("v", [6, 5, 8], "ms"))
        for (i, j, k), (value, point) in zip(places, found):
            self.assertEqual(value, self.value(i, j, k))
            # the plain grid: X along crosslines, Y along inlines, z up
            self.assertEqual([round(x, 6) for x in point], [j, i, -4 * k])
        # A turned survey: the directions that NRRD states, z up.
        survey = self.footwall("info", "s.nrrd")
        samples = self.samples("s.footwall")
        _, _, _, found = self.read_with_vtk("s.vti", places)
        for place, (value, point) in zip(places, found):
            want = [survey["origin"][n] + sum(place[axis] * survey["axes"][axis]["direction"][n] for axis in range(3))
                    for n in range(3)]
            for got, wanted in zip(point, (want[0], want[1], -want[2])):
                self.assertAlmostEqual(got, wanted, places=3)
            self.assertEqual(value, samples[(place[0] * 10 + place[1]) * 8 + place[2]])


if __name__ == "__main__":
    unittest.main()

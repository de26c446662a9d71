"""Surfaces in and faces out, as a user of GOCAD, ParaView or Petrel meets them."""
import csv
import json
import pathlib
import re
import subprocess
import unittest

from support import FootwallTest, test_data

DATA = test_data()

SQUARE = """GOCAD TSurf 1
HEADER {{
name:{name}
}}
GOCAD_ORIGINAL_COORDINATE_SYSTEM
NAME Default
AXIS_NAME "X" "Y" "Z"
AXIS_UNIT "m" "m" "{unit}"
ZPOSITIVE {positive}
END_ORIGINAL_COORDINATE_SYSTEM
TFACE
VRTX 1 {x0} {y0} {z0}
VRTX 2 {x1} {y1} {z0}
VRTX 3 {x1} {y1} {z1}
VRTX 4 {x0} {y0} {z1}
TRGL 1 2 3
TRGL 1 3 4
END
"""


def table_of(path):
    with open(path, newline="") as table:
        return list(csv.DictReader(table))


def vertices(path):
    rows = [line.split() for line in pathlib.Path(path).read_text().splitlines()]
    return [tuple(map(float, row[2:5])) for row in rows if row and row[0] in ("VRTX", "PVRTX")]


def triangles(path):
    return [line.split()[1:4] for line in pathlib.Path(path).read_text().splitlines() if line.startswith("TRGL")]


def debian_python_with_vtk():
    """Debian's interpreter, where its VTK is installed (python3-vtk9)."""
    try:
        done = subprocess.run(["/usr/bin/python3", "-c", "import vtkmodules.vtkIOXML"], capture_output=True)
    except OSError:
        return None
    return "/usr/bin/python3" if done.returncode == 0 else None


class Surfaces(FootwallTest):
    def square_across(self, project, name="sq", unit="ms", positive="Depth", scale=1.0):
        """A file with two triangles through the middle of the survey."""
        survey = self.footwall("info", project)["survey"]
        (x, y), along, across = (survey["map"][key] for key in ("origin", "per_inline", "per_crossline"))
        i, j0, j1 = survey["inlines"]["count"] // 2, 3, survey["crosslines"]["count"] - 4
        corner = lambda j: (x + i * along[0] + j * across[0], y + i * along[1] + j * across[1])
        (x0, y0), (x1, y1) = corner(j0), corner(j1)
        sign = -scale if positive == "Elevation" else scale
        z0 = sign * (survey["z0"] + 3 * survey["interval"])
        z1 = sign * (survey["z0"] + (survey["samples"] - 4) * survey["interval"])
        text = SQUARE.format(name=name, unit=unit, positive=positive, x0=x0, x1=x1, y0=y0, y1=y1, z0=z0, z1=z1)
        path = self.folder / (re.sub(r"\W", "_", name) + ".ts")
        path.write_text(text)
        return path

    def test_a_surface_takes_part_in_everything(self):
        project = self.synthetic()
        report = self.footwall("import", "surface", project, self.square_across(project, "Störung 7"))
        self.assertEqual((report["read"], report["rejected"], report["assumed"]), (6, [], []))
        self.assertEqual(report["faults"], [{"name": "Störung 7", "vertices": 4, "triangles": 2}])
        fault = next(f for f in self.footwall("info", project)["faults"] if f["name"] == "Störung 7")
        self.assertEqual((fault["surface"], fault["pillars"], fault["vertices"], fault["faces"], fault["stale"]),
                         ("gocad_tsurf", 0, 4, 2, False))
        self.assertIn("surface, 4 vertices, 2 triangles", self.start("faults", project).stdout)
        # The same plane in seconds and as elevation is the same surface.
        self.footwall("import", "surface", project, self.square_across(project, "again", "s", "Elevation", 1e-3))
        run = self.footwall("extract", project, "--ranks", 2)
        self.assertGreater(run["voxels"], 500)
        self.footwall("faces", project, "--csv", "f.csv")
        rows = table_of(self.folder / "f.csv")
        first, again = ([r for r in rows if r["fault"] == name] for name in ("Störung 7", "again"))
        self.assertEqual([r["face"] for r in first], ["1.0", "1.1"])
        self.assertGreater(int(first[0]["count"]), 200)
        for a, b in zip(first, again):
            self.assertEqual((a["count"], a["mean"], a["variance"]), (b["count"], b["mean"], b["variance"]))
        self.footwall("render", project, "--faults", "--out", "p.png", "--size", "300x200")
        self.footwall("triangulate", project)
        self.footwall("interpolate", project, "--every", 4)  # the other faults; a surface has no pillars
        self.refused(1, "interpolate", project, "--every", 4, "--fault", "again")
        pillar = json.dumps({"op": "add", "what": "pillar", "fault": "again", "nodes": [[1, 2, 3]]})
        refused = self.start("edit", project, stdin=pillar)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("imported surface", refused.stderr)
        # Deleting the fault deletes its surface, and undo brings both back.
        before = len(self.footwall("info", project)["surfaces"])
        self.start("edit", project, stdin=json.dumps({"op": "delete", "what": "fault", "fault": "again"}))
        self.assertEqual(len(self.footwall("info", project)["surfaces"]), before - 1)
        self.footwall("undo", project)
        self.assertEqual(len(self.footwall("info", project)["surfaces"]), before)
        self.footwall("info", project, "--verify")

    def test_units_of_another_domain_are_refused(self):
        project = self.synthetic()
        error = self.refused(1, "import", "surface", project, self.square_across(project, unit="ft"))
        self.assertIn("--z-unit", error["hint"])
        self.assertEqual(self.footwall("info", project)["surfaces"], [])
        self.footwall("import", "surface", project, self.square_across(project, unit="ft"), "--z-unit", "ms",
                      "--z-positive", "down", "--name", "told")
        self.refused(2, "import", "surface", project, "no.ts", "--z-unit", "km")
        self.refused(1, "import", "surface", project, "no.ts")
        self.refused(2, "export", project, "--tsurf", "x.ts", "--z-unit", "ft")
        (self.folder / "text.ts").write_text("no surface\n")
        self.refused(1, "import", "surface", project, "text.ts")

    def test_out_and_in_again_is_the_identity(self):
        self.footwall("new", "a.footwall")
        given = SQUARE.format(name="A fault öst", unit="ft", positive="Elevation", x0=458177.76709, y0=7322538.712891,
                              x1=458300.5, y1=7322600.25, z0=-1643.655884, z1=-1900.0)
        (self.folder / "in.ts").write_bytes(given.replace("\n", " \r\n").encode())
        self.footwall("import", "surface", "a.footwall", "in.ts")
        for positive in ("up", "down"):
            for unit in ("ft", "m"):
                out, name = f"{positive}{unit}.ts", f"{positive}{unit}.footwall"
                self.footwall("export", "a.footwall", "--tsurf", out, "--z-positive", positive, "--z-unit", unit)
                text = (self.folder / out).read_text()
                self.assertIn(f'AXIS_UNIT "m" "m" "{unit}"', text)
                self.assertIn("ZPOSITIVE " + {"up": "Elevation", "down": "Depth"}[positive], text)
                self.footwall("new", name)
                self.assertEqual(self.footwall("import", "surface", name, out)["assumed"], [])
                self.footwall("export", name, "--tsurf", "again.ts", "--z-positive", positive)
                self.assertEqual((self.folder / "again.ts").read_text(), text)
        self.assertEqual(vertices(self.folder / "upft.ts")[0], (458177.76709, 7322538.712891, -1643.655884))

    def test_csv_declares_what_its_numbers_are(self):
        project = self.synthetic()
        self.footwall("triangulate", project)
        self.footwall("export", project, "--csv", "a.csv")
        self.footwall("export", project, "--csv", "b.csv", "--z-unit", "s", "--z-positive", "up")
        a, b = (table_of(self.folder / name) for name in ("a.csv", "b.csv"))
        self.assertEqual((a[0]["z_unit"], a[0]["z_positive"], a[0]["xy_unit"]), ("ms", "down", "m"))
        self.assertEqual((b[0]["z_unit"], b[0]["z_positive"]), ("s", "up"))
        for row, turned in zip(a, b):
            self.assertAlmostEqual(float(row["z1"]), -1000 * float(turned["z1"]), places=9)
            self.assertEqual(row["x1"], turned["x1"])

    def test_petrel_gets_sticks_points_surfaces_and_a_note(self):
        project = self.synthetic()
        self.footwall("triangulate", project)
        self.footwall("import", "surface", project, self.square_across(project, "a surface {1}"))
        self.footwall("extract", project)
        done = self.footwall("export", project, "--for", "petrel", "--out", "out folder")
        names = ["fault_sticks.txt", "face_points.txt", "faults.ts", "README.txt"]
        self.assertEqual(done["files"], ["out folder/" + name for name in names])
        self.assertEqual(done["renamed"], ["a surface {1} -> a surface (1)", "a surface {1} -> a_surface_{1}"])
        note = (self.folder / "out folder" / "README.txt").read_text()
        for line in (r"Domain +time", r"Unit of z +ms", r"Sign of z +positive up", r"CRS +synthetic", r"-99999"):
            self.assertRegex(note, line)
        # Sticks: true line numbers, elevation, and the pillars come back as they were.
        sticks = (self.folder / "out folder" / "fault_sticks.txt").read_text().splitlines()
        rows = [line for line in sticks if line.startswith("INLINE")]
        survey = self.footwall("info", project)["survey"]
        nodes = [node for fault in self.footwall("faults", project)["faults"] for pillar in fault["pillars"]
                 for node in pillar["nodes"]]
        self.assertEqual(len(rows), len(nodes))
        for row, node in zip(rows, nodes):
            numbers = re.findall(r"-?\d+(?:\.\d+)?", row.replace("INLINE-", ""))
            self.assertAlmostEqual(float(numbers[0]), node["inline"], delta=survey["inlines"]["step"] / 2 + 1e-6)
            self.assertAlmostEqual(float(numbers[1]), node["crossline"], delta=survey["crosslines"]["step"] / 2 + 1e-6)
            self.assertAlmostEqual(float(numbers[4]), -node["z"], delta=0.0001)
        # One point a face, at its centroid, with the numbers of the table.
        self.footwall("export", project, "--csv", "f.csv")
        table = table_of(self.folder / "f.csv")
        points = (self.folder / "out folder" / "face_points.txt").read_text().splitlines()
        head = points[0].split()
        self.assertEqual(head[:6], ["X", "Y", "Z", "fault", "face", "count"])
        self.assertEqual(len(points), len(table) + 1)
        for line, row in zip(points[1:], table):
            point = dict(zip(head, line.split()))
            for axis, sign in (("x", 1), ("y", 1), ("z", -1)):
                centre = sum(float(row[axis + str(n)]) for n in range(3)) / 3
                self.assertAlmostEqual(float(point[axis.upper()]), sign * centre, delta=1e-6)
            self.assertEqual(float(point["variance"]), float(row["variance"] or -99999))
        self.assertIn("ZPOSITIVE Elevation", (self.folder / "out folder" / "faults.ts").read_text())
        # The other sign, another unit, another project's empty hands.
        self.footwall("export", project, "--for", "petrel", "--out", "d", "--z-positive", "down", "--z-unit", "s",
                      "--fault", "planar")
        self.assertRegex((self.folder / "d" / "README.txt").read_text(), r"Unit of z +s\nSign of z +positive down")
        self.assertIn("ZPOSITIVE Depth", (self.folder / "d" / "faults.ts").read_text())
        self.refused(2, "export", project, "--for", "petrel")
        self.refused(2, "export", project, "--for", "excel", "--out", "x")
        self.footwall("new", "empty.footwall")
        self.refused(1, "export", "empty.footwall", "--for", "petrel", "--out", "x")

    def test_paraview_reads_what_was_written(self):
        python = debian_python_with_vtk()
        if python is None:
            self.skipTest("python3-vtk9 is not installed")
        project = self.synthetic()
        self.footwall("triangulate", project)
        self.footwall("import", "surface", project, self.square_across(project, "Störung <7>"))
        self.footwall("extract", project)
        self.footwall("export", project, "--vtp", "f.vtp", "--csv", "f.csv", "--z-unit", "s")
        script = """
import json, sys
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
reader = vtkXMLPolyDataReader()
reader.SetFileName(sys.argv[1])
reader.Update()
data = reader.GetOutput()
cells, field = data.GetCellData(), data.GetFieldData()
text = lambda name: [field.GetAbstractArray(name).GetValue(n)
                     for n in range(field.GetAbstractArray(name).GetNumberOfValues())]
names = [cells.GetAbstractArray(n).GetName() for n in range(cells.GetNumberOfArrays())]
faces = []
for n in range(data.GetNumberOfCells()):
    cell = data.GetCell(n)
    face = {"type": cell.GetCellType(), "points": [data.GetPoint(cell.GetPointId(k)) for k in range(3)]}
    for name in names:
        face[name] = cells.GetAbstractArray(name).GetValue(n)
    faces.append(face)
print(json.dumps({"precision": data.GetPoints().GetDataType(), "faces": faces,
                  **{name: text(name) for name in
                     ("fault_names", "horizontal_unit", "vertical_unit", "z_positive", "crs")}}))
"""
        done = subprocess.run([python, "-c", script, self.path("f.vtp")], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        seen = json.loads(done.stdout)
        table = table_of(self.folder / "f.csv")
        self.assertEqual(seen["precision"], 11)  # VTK_DOUBLE
        self.assertEqual((seen["vertical_unit"], seen["z_positive"]), (["s"], ["up"]))
        self.assertIn("Störung <7>", seen["fault_names"])
        self.assertEqual(len(seen["faces"]), len(table))
        for face, row in zip(seen["faces"], table):
            self.assertEqual(face["type"], 5)  # a triangle
            self.assertEqual(face["face"], row["face"])
            self.assertEqual(seen["fault_names"][face["fault"]], row["fault"])
            for point, corner in zip(face["points"], "021"):  # turned with the axis
                self.assertEqual(point, [float(row["x" + corner]), float(row["y" + corner]), -float(row["z" + corner])])
            if row["variance"]:
                self.assertEqual(face["variance"], float(row["variance"]))


@unittest.skipIf(DATA is None, "skipped: no folder of real test files (FOOTWALL_TEST_DATA)")
class RealSurfaces(FootwallTest):
    def test_the_community_fault_model_through_the_whole_command(self):
        rows = table_of(DATA / "_derived" / "cfm_facts_open.csv")
        # Some of each kind: plain, in parts, with atoms and properties, non-manifold, with disagreeing windings.
        chosen = {row["file"]: row for row in rows[::60]}
        for test in (lambda r: r["atom"] != "0", lambda r: r["pvrtx"] != "0", lambda r: r["nonmanifold_edges"] != "0",
                     lambda r: r["inconsistent_edges"] != "0", lambda r: r["tface"] not in ("0", "1")):
            chosen.update({row["file"]: row for row in list(filter(test, rows))[:1]})
        self.footwall("new", "cfm.footwall")
        for file, row in chosen.items():
            with self.subTest(file):
                (fault,) = self.footwall("import", "surface", "cfm.footwall", DATA / file)["faults"]
                facts = next(f for f in self.footwall("info", "cfm.footwall")["faults"] if f["name"] == fault["name"])
                for key, stated in (("vertices", "vertices"), ("faces", "triangles"), ("components", "components"),
                                    ("boundary_loops", "boundary_loops"), ("euler", "euler")):
                    self.assertEqual(facts[key], int(row[stated]), key)
                self.assertAlmostEqual(facts["area"] / float(row["area_m2"]), 1, places=9)
                # Out, in and out again.
                self.footwall("export", "cfm.footwall", "--tsurf", "1.ts", "--fault", fault["name"], "--z-positive", "up")
                (self.folder / "again.footwall").unlink(missing_ok=True)
                self.footwall("new", "again.footwall")
                self.footwall("import", "surface", "again.footwall", "1.ts")
                self.footwall("export", "again.footwall", "--tsurf", "2.ts", "--z-positive", "up")
                self.assertEqual((self.folder / "1.ts").read_text(), (self.folder / "2.ts").read_text())
                found = vertices(self.folder / "1.ts")
                self.assertEqual((len(found), len(triangles(self.folder / "1.ts"))),
                                 (int(row["vertices"]), int(row["triangles"])))
                for axis, name in enumerate("xyz"):
                    self.assertAlmostEqual(min(p[axis] for p in found), float(row[name + "min"]), delta=5.1e-5)
                    self.assertAlmostEqual(max(p[axis] for p in found), float(row[name + "max"]), delta=5.1e-5)


if __name__ == "__main__":
    unittest.main()

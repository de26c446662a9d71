"""Sticks in the formats of other programs, through the command line: out and in again, units, refusals."""
import unittest

from support import FootwallTest, test_data


class VendorSticks(FootwallTest):
    def nodes(self, project):
        """Fault -> list of pillars, each a list of positions."""
        faults = self.footwall("faults", project)["faults"]
        return {fault["name"]: [[(node["x"], node["y"], node["z"]) for node in pillar["nodes"]]
                                for pillar in fault["pillars"]] for fault in faults}

    def empty(self, name):
        project = self.footwall("new", name)
        self.assertTrue(project)
        return name

    def assert_same(self, first, again):
        self.assertEqual(len(first), len(again))
        for one, other in zip(first, again):
            self.assertEqual(len(one), len(other))
            for here, there in zip(one, other):
                for a, b in zip(here, there):
                    self.assertAlmostEqual(a, b, delta=0.5001e-4)

    def test_what_is_exported_comes_in_again(self):
        project = self.synthetic()
        before = self.nodes(project)
        for name in ("pline", "cps3", "zmap", "rms"):
            for direction in ("down", "up"):
                with self.subTest(format=name, direction=direction):
                    out = f"{name}-{direction}.txt"
                    self.footwall("export", project, "--sticks", out, "--stick-format", name, "--fault", "planar",
                                  "--z-positive", direction)
                    told = [] if name in ("pline", "zmap") else ["--z-positive", direction]
                    target = self.empty(f"{name}-{direction}.footwall")
                    answer = self.footwall("import", "sticks", target, out, "--fault", "planar", *told)
                    self.assertEqual(answer["format"], name)
                    self.assertEqual(answer["rejected"], [])
                    self.assert_same(before["planar"], self.nodes(target)["planar"])

    def test_several_faults_in_one_polyline_file(self):
        project = self.synthetic()
        before = self.nodes(project)
        self.footwall("export", project, "--sticks", "all.pl", "--stick-format", "pline")
        target = self.empty("all.footwall")
        self.footwall("import", "sticks", target, "all.pl")
        after = self.nodes(target)
        self.assertEqual(list(before), list(after))
        for name, pillars in before.items():
            self.assert_same(pillars, after[name])

    def test_a_contradiction_between_option_and_file_is_told(self):
        self.empty("e.footwall")
        (self.folder / "up.pl").write_text("GOCAD PLine 1\nHEADER {\nname:F\n}\nZPOSITIVE Elevation\nILINE\n"
                                           "VRTX 1 1 2 -3\nVRTX 2 1 2 -4\nSEG 1 2\nEND\n")
        answer = self.footwall("import", "sticks", "e.footwall", "up.pl", "--z-positive", "down")
        self.assertTrue(any("the file says up" in notice for notice in answer["notices"]), answer["notices"])

    def test_seisworks_columns_need_their_format_file(self):
        self.empty("e.footwall")
        (self.folder / "columns.dat").write_text(" 433270.0 6786390.0  810.0 1 ms\n 433310.0 6786350.0  860.0 3 ms\n"
                                                 " 433310.0 6786350.0  86x.0 1 ms\n")
        error = self.refused(2, "import", "sticks", "e.footwall", "columns.dat", "--format", "landmark")
        self.assertIn("format file", error["message"])
        (self.folder / "layout.txt").write_text("FAULT_X 1 9\nFAULT_Y 10 19\nFAULT_Z 20 26\nFAULT_PTYPE 27 28\n")
        answer = self.footwall("import", "sticks", "e.footwall", "columns.dat", "--layout", "layout.txt", "--fault", "F")
        self.assertEqual((answer["read"], answer["format"]), (2, "landmark"))
        self.assertEqual([(row["line"], row["column"]) for row in answer["rejected"]], [(3, 22)])

    def test_what_is_no_stick_is_refused_by_name(self):
        self.empty("e.footwall")
        files = {"t.ts": ("GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nEND\n", "TSurf"),
                 "g.cps": ("FSASCI 0 1 0 5 1.0E+30\nFSLIMI 0 1 0 1 0 1\n->\n1 2\n", "CPS-3 grid"),
                 "g.zmap": ("@top, GRID, 5\n20, 1E30, , 4, 1\n@\n1 2\n", "ZMAP+ grid"),
                 "h.dat": ("PROFILE H1               TYPE 1  4 3d_ci7m.ifdf m  ms\n 1 2 3\n", "H1"),
                 "i.irap": ("-996 2 25.0 25.0\n1 2 3 4\n", "IRAP")}
        for name, (text, said) in files.items():
            with self.subTest(file=name):
                (self.folder / name).write_text(text)
                self.assertIn(said, self.refused(1, "import", "sticks", "e.footwall", name)["message"])

    def test_real_polygons(self):
        if test_data() is None:
            self.skipTest("the real test files are not there")
        self.empty("e.footwall")
        folder = test_data() / "equinor+xtgeo-testdata" / "polygons" / "reek" / "1"
        rows = [row.split(",") for row in (folder / "top_upper_reek_faultpoly.csv").read_text().splitlines()[1:] if row]
        answer = self.footwall("import", "sticks", "e.footwall", folder / "top_upper_reek_faultpoly.pol")
        self.assertEqual(answer["format"], "rms")
        self.assertEqual(answer["pillars"], len({row[3] for row in rows}))
        self.assertEqual(answer["read"], len(rows))


if __name__ == "__main__":
    unittest.main()

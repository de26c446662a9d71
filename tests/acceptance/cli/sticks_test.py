"""Fault sticks in and out, as an interpreter meets them."""
import pathlib
import unittest

from support import FootwallTest, test_data


class Sticks(FootwallTest):
    def pillars(self, project, fault):
        """The positions of a fault's pillars."""
        fault = next(f for f in self.footwall("faults", project)["faults"] if f["name"] == fault)
        return [[(n["x"], n["y"], n["z"]) for n in pillar["nodes"]] for pillar in fault["pillars"]]

    def same(self, found, expected, within):
        self.assertEqual([len(p) for p in found], [len(p) for p in expected])
        for a, b in zip(sum(found, []), sum(expected, [])):
            for n in range(3):
                self.assertAlmostEqual(a[n], b[n], delta=within)

    def written_formats(self):
        """What --help offers for --stick-format."""
        text = self.start("export", "--help").stdout.split("--stick-format", 1)[1].split("--sticks:", 1)[1]
        return [name.strip() for name in text.split("\n", 1)[0].split(",")]

    def test_every_format_brings_back_what_it_took(self):
        project = self.synthetic()
        name = "Störung 7 West"
        edits = [f'{{"op":"add","what":"fault","name":"{name}"}}']
        for nodes in ("[[433300.12345,6786400.5,820.06],[433310.5,6786390.25,904.5]]", "[[433400,6786300,900]]"):
            edits.append(f'{{"op":"add","what":"pillar","fault":"{name}","nodes":{nodes}}}')
        self.start("edit", project, stdin="\n".join(edits) + "\n").check_returncode()
        before = self.pillars(project, name)
        formats = self.written_formats()
        self.assertGreaterEqual(len(formats), 6)
        self.footwall("new", "back.footwall", "--synthetic", "faulted", "--size", "40x36x32", "--seed", 3)
        for number, form in enumerate(formats):
            for sign, unit in (("down", "ms"), ("up", "s")):
                with self.subTest(format=form, z=sign, unit=unit):
                    told = ["--z-positive", sign, "--z-unit", unit]
                    done = self.footwall("export", project, "--sticks", "o.txt", "--stick-format", form, "--fault", name, *told)
                    self.assertEqual(done["sticks"]["pillars"], 2)
                    wanted = f"{number} {sign}"
                    text = (self.folder / "o.txt").read_bytes()
                    (self.folder / "o.txt").write_bytes(text.replace(b"\n", b"\r\n"))
                    report = self.footwall("import", "sticks", "back.footwall", "o.txt", "--format", form, "--fault", wanted, *told)
                    self.assertEqual(report["rejected"], [])
                    self.assertEqual(report["format"], form)
                    self.assertEqual(report["read"], 3)
                    if not done["sticks"]["renamed"] and not report["renamed"]:
                        self.assertEqual(report["faults"], [name])
                    self.same(self.pillars("back.footwall", report["faults"][0]), before, 5.001e-4)
                    self.footwall("undo", "back.footwall")

    def test_line_numbers_are_those_of_the_survey(self):
        project = self.synthetic()
        self.footwall("export", project, "--sticks", "c.txt")
        survey = self.footwall("info", project)["survey"]
        for row in (self.folder / "c.txt").read_text().splitlines():
            _, inline, crossline, *_ = row.split()
            self.assertIn(int(inline), range(survey["inlines"]["first"], survey["inlines"]["last"] + 1))
            self.assertIn(int(crossline), range(survey["crosslines"]["first"], survey["crosslines"]["last"] + 1))
        # By its lines alone each point comes back to within half a line.
        rows = [row.split() for row in (self.folder / "c.txt").read_text().splitlines()]
        (self.folder / "l.txt").write_text("".join(f"{r[1]} {r[2]} {r[5]} {r[7]} {r[6]}\n" for r in rows))
        report = self.footwall("import", "sticks", project, "l.txt", "--columns", "inline=1,crossline=2,z=3,stick=4,name=5")
        self.assertEqual(report["read"], len(rows))
        self.assertEqual(report["notices"], [])
        self.same(self.pillars(project, "planar (2)"), self.pillars(project, "planar"), 30)

    def test_a_preview_changes_nothing(self):
        project = self.synthetic()
        self.footwall("export", project, "--sticks", "c.txt")
        before = self.footwall("faults", project)
        preview = self.footwall("import", "sticks", project, "c.txt", "--preview")
        self.assertEqual(preview["format"], "charisma")
        self.assertEqual(len(preview["rows"]), 20)
        self.assertEqual(preview["rows"][0]["fault"], "planar (2)")
        self.assertEqual(preview["pillars"], sum(len(f["pillars"]) for f in before["faults"]))
        self.assertEqual(self.footwall("faults", project), before)

    def test_bad_rows_are_told_and_the_rest_is_read(self):
        project = self.synthetic()
        (self.folder / "c.txt").write_text("INLINE- 300 610 433303 6786359 800 F 1\nINLINE- 300 610 433303 oops 810 F 1\n"
                                           "INLINE- 300 610 433303 6786359 820 F 1\nINLINE- 310 610 433303 6786359 830 F 1\n")
        report = self.footwall("import", "sticks", project, "c.txt")
        self.assertEqual((report["read"], report["skipped"]), (3, 0))
        self.assertEqual([(r["line"], r["column"]) for r in report["rejected"]], [(2, 24)])
        self.assertIn("oops", report["rejected"][0]["reason"])
        self.assertIn("z is positive down", report["assumed"])
        self.assertIn("1 rows contradict", report["notices"][0])
        self.assertIn("z is positive up, as told", self.footwall("import", "sticks", project, "c.txt", "--z-up")["assumed"])

    def test_what_cannot_be_is_refused_with_a_way_out(self):
        project = self.synthetic()
        self.footwall("new", "empty.footwall")
        (self.folder / "l.txt").write_text("300 610 800 1\n")
        lines = ("l.txt", "--columns", "inline=1,crossline=2,z=3,stick=4")
        self.assertIn("import volume", self.refused(1, "import", "sticks", "empty.footwall", *lines)["hint"])
        self.assertIn("velocity", self.refused(2, "import", "sticks", project, *lines, "--z-unit", "ft")["hint"])
        self.refused(2, "import", "sticks", project, "l.txt", "--columns", "x=1")
        self.refused(2, "import", "sticks", project, "l.txt", "--header-rows", "1")
        self.refused(2, "import", "sticks", project, *lines, "--format", "charisma")
        self.refused(2, "import", "sticks", project, "l.txt", "--format", "telepathy")
        (self.folder / "t.ts").write_text("GOCAD TSurf 1\nHEADER {\nname:F\n}\nTFACE\nEND\n")
        self.assertIn("import surface", self.refused(1, "import", "sticks", project, "t.ts")["hint"])
        self.assertIn("--fault", self.refused(2, "export", project, "--sticks", "o", "--stick-format", "xyz")["hint"])
        self.refused(2, "export", project, "--sticks", "o", "--z-unit", "m")
        self.refused(2, "export", project, "--sticks", "o", "--stick-format", "telepathy")
        self.refused(1, "export", project, "--sticks", project)
        self.assertFalse((self.folder / "o").exists())

    @unittest.skipIf(test_data() is None, "no folder of real test files")
    def test_real_polygons_as_a_table(self):
        polygons = pathlib.Path(test_data()) / "equinor+xtgeo-testdata" / "polygons" / "reek" / "1"
        self.footwall("new", "reek.footwall")
        report = self.footwall("import", "sticks", "reek.footwall", polygons / "top_upper_reek_faultpoly.csv")
        self.assertEqual((report["format"], report["read"], report["pillars"]), ("columns", 754, 7))
        self.assertIn("stick=4,x=1,y=2,z=3", report["assumed"][0])


if __name__ == "__main__":
    unittest.main()

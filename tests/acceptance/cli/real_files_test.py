"""The real F3 cut-out and its variants, and the real fault sticks, through the programs."""
import json
import pathlib
import unittest

from support import FootwallTest, test_data

DATA = test_data()
SEGYIO = (DATA or pathlib.Path()) / "equinor+segyio" / "test-data"


@unittest.skipIf(DATA is None, "skipped: no folder of real test files (FOOTWALL_TEST_DATA)")
class RealFiles(FootwallTest):
    def imported(self, name, file):
        self.footwall("new", name, "--segy", file, "--domain", "time", "--vertical-unit", "ms")
        raw = self.path(name + ".raw")
        self.footwall("export", name, "--raw", raw)
        return pathlib.Path(raw).read_bytes()

    def test_f3_and_its_format_variants_are_one_volume(self):
        wanted = self.imported("f3.footwall", SEGYIO / "f3.sgy")
        self.assertEqual(len(wanted), 23 * 18 * 75 * 4)
        for variant in ("Format1msb", "Format1lsb", "Format2msb", "Format3msb", "Format3lsb", "Format5msb", "Format5lsb"):
            with self.subTest(variant):
                self.assertEqual(self.imported(variant + ".footwall", SEGYIO / "multiformats" / (variant + ".sgy")), wanted)

    def test_a_project_made_from_f3_goes_all_the_way(self):
        self.imported("f3.footwall", SEGYIO / "f3.sgy")
        survey = self.footwall("info", "f3.footwall")["survey"]
        self.assertEqual((survey["inlines"]["first"], survey["inlines"]["last"]), (111, 133))
        lines = [{"op": "add", "what": "fault", "name": "F1"}]
        for inline in (113, 118, 124, 131):
            lines.append({"op": "add", "what": "pillar", "fault": "F1", "nodes": [
                {"inline": inline, "crossline": 878, "z": 20}, {"inline": inline, "crossline": 884, "z": 150},
                {"inline": inline, "crossline": 889, "z": 280}]})
        done = self.start("edit", "f3.footwall", stdin="\n".join(map(json.dumps, lines)))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.footwall("triangulate", "f3.footwall")
        first = self.footwall("extract", "f3.footwall", "--ranks", 2)
        self.assertGreater(first["voxels"], 500)
        self.footwall("undo", "f3.footwall")
        self.assertEqual(self.footwall("info", "f3.footwall")["faults"][0]["pillars"], 3)
        smaller = self.footwall("extract", "f3.footwall", "--ranks", 2)
        self.assertLess(smaller["voxels"], first["voxels"])
        self.footwall("redo", "f3.footwall")
        self.assertEqual(self.footwall("extract", "f3.footwall", "--ranks", 3)["checksum"], first["checksum"])
        self.footwall("render", "f3.footwall", "--faults", "--section", "inline=120", "--out", "f3.png", "--size", "400x300")
        self.assertGreater((self.folder / "f3.png").stat().st_size, 2000)

    def test_the_real_charisma_file(self):
        self.imported("f3.footwall", SEGYIO / "f3.sgy")
        sticks = DATA / "softwareunderground+subsurface" / "tests" / "data" / "faults" / "faultsticks"
        report = self.footwall("import", "sticks", "f3.footwall", sticks)
        self.assertEqual((report["read"], report["rejected"]), (12, []))
        (fault,) = self.footwall("info", "f3.footwall")["faults"]
        self.assertEqual((fault["name"], fault["pillars"]), ("gp_fault7", 4))
        nodes = self.footwall("faults", "f3.footwall")["faults"][0]["pillars"]
        self.assertEqual([len(pillar["nodes"]) for pillar in nodes], [3, 3, 3, 3])


if __name__ == "__main__":
    unittest.main()

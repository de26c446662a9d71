"""Each command's contract, its refusals, and that nothing the user did is lost."""
import array
import json
import math
import pathlib
import signal
import struct
import subprocess
import time
import unittest

from support import BIN, FootwallTest


class Commands(FootwallTest):
    def test_new_and_info_tell_what_is_there(self):
        project = self.synthetic()
        info = self.footwall("info", project)
        self.assertEqual(info["schema"], 4)
        self.assertEqual((info["survey"]["inlines"]["count"], info["survey"]["crosslines"]["count"],
                          info["survey"]["samples"]), (40, 36, 32))
        self.assertIn(info["survey"]["vertical_unit"], ("ms", "m", "ft"))
        (volume,) = info["volumes"]
        self.assertEqual(volume["dims"], [40, 36, 32])
        self.assertEqual(volume["live_traces"], 40 * 36)
        self.assertEqual(volume["null_count"], 0)
        self.assertLess(volume["min"], volume["max"])
        self.assertEqual(len(info["faults"]), 3)
        for fault in info["faults"]:
            self.assertGreater(fault["pillars"], 1)
        self.assertEqual(len(info["truth"]), 3)
        self.assertEqual((info["missing"], info["assumed"]), ([], []))
        self.footwall("triangulate", project)
        for fault in self.footwall("info", project)["faults"]:
            self.assertGreater(fault["faces"], 0)
            self.assertEqual((fault["components"], fault["boundary_loops"], fault["euler"]), (1, 1, 1), fault["name"])

    def test_same_seed_same_bytes(self):
        for name in ("a.footwall", "b.footwall"):
            self.synthetic(name)
        checksums = [self.footwall("info", name)["volumes"][0]["checksum"] for name in ("a.footwall", "b.footwall")]
        self.assertEqual(*checksums)
        self.synthetic("c.footwall", seed=4)
        self.assertNotEqual(self.footwall("info", "c.footwall")["volumes"][0]["checksum"], checksums[0])

    def test_new_refuses_to_overwrite(self):
        project = self.synthetic()
        error = self.refused(1, "new", project, "--synthetic", "faulted", "--size", "8x8x8", "--seed", 1)
        self.assertIn(project, error["message"])

    def test_raw_goes_in_and_comes_out_the_same(self):
        values = array.array("f", [math.sin(n) for n in range(6 * 5 * 4)])
        pathlib.Path(self.path("in.raw")).write_bytes(values.tobytes())
        self.footwall("new", "r.footwall", "--raw", "in.raw", "--dims", "6x5x4", "--domain", "time",
                      "--vertical-unit", "ms", "--interval", 4)
        self.footwall("export", "r.footwall", "--raw", "out.raw")
        self.assertEqual(pathlib.Path(self.path("out.raw")).read_bytes(), values.tobytes())
        # The other axis order: fastest first on disk is the inline.
        turned = array.array("f", [values[(i * 5 + j) * 4 + k] for k in range(4) for j in range(5) for i in range(6)])
        pathlib.Path(self.path("turned.raw")).write_bytes(turned.tobytes())
        self.footwall("import", "volume", "r.footwall", "turned.raw", "--raw", "--dims", "6x5x4", "--axes", "kji",
                      "--name", "turned")
        self.footwall("export", "r.footwall", "--volume", "turned", "--raw", "out2.raw")
        self.assertEqual(pathlib.Path(self.path("out2.raw")).read_bytes(), values.tobytes())
        self.refused(1, "import", "volume", "r.footwall", "turned.raw", "--raw", "--dims", "6x5x5", "--name", "bad")
        self.assertEqual(len(self.footwall("info", "r.footwall")["volumes"]), 2)

    def test_nan_and_nulls_are_counted_not_used(self):
        values = array.array("f", [1.0] * 60)
        values[7] = math.nan
        values[9] = -999.25
        pathlib.Path(self.path("n.raw")).write_bytes(values.tobytes())
        self.footwall("new", "n.footwall", "--raw", "n.raw", "--dims", "3x4x5", "--domain", "depth", "--vertical-unit",
                      "m", "--interval", 5, "--null", -999.25)
        (volume,) = self.footwall("info", "n.footwall")["volumes"]
        self.assertEqual((volume["null_count"], volume["min"], volume["max"]), (2, 1, 1))

    def test_edits_undo_and_redo_over_restarts(self):
        project = self.synthetic()
        before = self.footwall("info", project)["faults"]
        lines = [{"op": "add", "what": "fault", "name": "new"}]
        replies = self.edit(project, lines)
        self.assertIn("fault", replies[0])
        survey = self.footwall("info", project)["survey"]
        first, step = survey["inlines"]["first"], survey["inlines"]["step"]
        crossline = survey["crosslines"]["first"]
        for n in range(3):
            self.edit(project, [{"op": "add", "what": "pillar", "fault": "new", "nodes": [
                {"inline": first + 4 * n * step, "crossline": crossline + 4, "z": survey["interval"] * 2},
                {"inline": first + 4 * n * step, "crossline": crossline + 9, "z": survey["interval"] * 25}]}])
        self.footwall("triangulate", project, "--fault", "new")
        after = self.footwall("info", project)["faults"]
        self.assertEqual([f["name"] for f in after], [f["name"] for f in before] + ["new"])
        self.assertEqual(after[-1]["pillars"], 3)
        for _ in range(4):
            self.footwall("undo", project)
        self.assertEqual([f["name"] for f in self.footwall("info", project)["faults"]], [f["name"] for f in before])
        for _ in range(4):
            self.footwall("redo", project)
        self.assertEqual(self.footwall("info", project)["faults"][-1]["pillars"], 3)
        self.refused(1, "redo", project)
        self.assertGreaterEqual(len(self.footwall("history", project)["steps"]), 4)

    def edit(self, project, lines):
        done = self.start("edit", project, stdin="\n".join(map(json.dumps, lines)) + "\n")
        self.assertEqual(done.returncode, 0, done.stderr)
        return [json.loads(line) for line in done.stdout.splitlines()]

    def test_a_bad_edit_names_its_line_and_changes_nothing(self):
        project = self.synthetic()
        before = self.footwall("info", project)["faults"]
        done = self.start("edit", project, stdin='{"op":"add","what":"pillar","fault":"nobody","nodes":[]}\n')
        self.assertEqual(done.returncode, 1)
        self.assertIn("line 1", done.stderr)
        self.assertEqual(self.footwall("info", project)["faults"], before)

    def test_interpolate_inserts_removable_pillars(self):
        project = self.synthetic()
        before = sum(f["pillars"] for f in self.footwall("info", project)["faults"])
        answer = self.footwall("interpolate", project, "--every", 2)
        after = sum(f["pillars"] for f in self.footwall("info", project)["faults"])
        self.assertGreater(after, before)
        self.assertEqual(answer["inserted"], after - before)
        self.footwall("triangulate", project)
        self.footwall("undo", project)
        self.assertLess(sum(f["pillars"] for f in self.footwall("info", project)["faults"]), after)
        self.footwall("redo", project)
        self.assertEqual(self.footwall("interpolate", project, "--remove")["removed"], answer["inserted"])
        self.assertEqual(sum(f["pillars"] for f in self.footwall("info", project)["faults"]), before)

    def test_exports_have_what_other_programs_read(self):
        project = self.synthetic()
        self.footwall("triangulate", project)
        self.footwall("extract", project, "--ranks", 1)
        self.footwall("export", project, "--vtp", "f.vtp", "--tsurf", "f.ts", "--csv", "f.csv")
        vtp = pathlib.Path(self.path("f.vtp")).read_bytes()
        self.assertIn(b'type="PolyData"', vtp[:300])
        self.assertIn(b'Name="variance"', vtp)
        self.assertIn(b'encoding="raw"', vtp)
        tsurf = pathlib.Path(self.path("f.ts")).read_text()
        self.assertEqual(tsurf.count("GOCAD TSurf 1"), 3)
        header = pathlib.Path(self.path("f.csv")).read_text().splitlines()[0]
        self.assertTrue(header.startswith(
            "fault,face,x0,y0,z0,x1,y1,z1,x2,y2,z2,count,nulls,outside,mean,variance,min,max,"), header)

    def test_render_draws_a_picture(self):
        project = self.synthetic()
        self.footwall("triangulate", project)
        self.footwall("extract", project, "--ranks", 1)
        inline = self.footwall("info", project)["survey"]["inlines"]["last"]
        self.footwall("render", project, "--faults", "--section", f"inline={inline}", "--out", "p.png", "--size", "320x200")
        png = pathlib.Path(self.path("p.png")).read_bytes()
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", png[16:24]), (320, 200))
        self.refused(1, "render", project, "--faults", "--section", "inline=-5", "--out", "q.png")
        self.assertFalse(pathlib.Path(self.path("q.png")).exists())

    def test_a_moved_volume_is_missing_until_relinked(self):
        project = self.synthetic()
        (volume,) = (self.folder / "s.footwall.volumes").glob("*.h5")
        elsewhere = self.folder / "moved.h5"
        volume.rename(elsewhere)
        self.assertEqual(len(self.footwall("info", project)["missing"]), 1)
        self.footwall("triangulate", project)
        error = self.refused(1, "extract", project)
        self.assertIn("relink", error["hint"])
        self.footwall("relink", project, elsewhere)
        self.assertEqual(self.footwall("info", project)["missing"], [])
        self.footwall("extract", project, "--ranks", 1)

    def test_verify_finds_a_flipped_byte(self):
        project = self.synthetic()
        self.footwall("info", project, "--verify")
        (volume,) = (self.folder / "s.footwall.volumes").glob("*.h5")
        data = bytearray(volume.read_bytes())
        data[len(data) // 2] ^= 1
        volume.write_bytes(data)
        self.assertEqual(self.refused(1, "info", project, "--verify")["code"], "corrupt")

    def test_segy_without_its_domain_is_wrong_usage(self):
        pathlib.Path(self.path("x.sgy")).write_bytes(bytes(3600))
        error = self.refused(2, "new", "x.footwall", "--segy", "x.sgy")
        self.assertIn("--domain", error["message"] + error["hint"])
        self.assertFalse(pathlib.Path(self.path("x.footwall")).exists())

    def test_wrong_usage_is_exit_2_and_json_has_the_error(self):
        self.assertEqual(self.refused(2, "nonsense")["code"], "usage")
        self.assertEqual(self.refused(1, "info", "nothing.footwall")["code"], "not_found")
        pathlib.Path(self.path("junk.footwall")).write_bytes(b"SQLite format 3\0" + bytes(5000))
        self.refused(1, "info", "junk.footwall")

    def test_bench_voxelize_counts(self):
        pathlib.Path(self.path("t.csv")).write_text("0,0,0,0,0,0,0,0,0\n0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5\n0,0,0,4,0,0,0,4,0\n")
        bench = self.footwall("bench", "voxelize", "--triangles", "t.csv", "--list", "l.csv")
        # A point in a voxel's centre meets it alone; one on a corner meets eight; closed cubes touch their neighbours.
        self.assertEqual(bench["counts"][:2], [1, 8])
        self.assertEqual(bench["voxels"], sum(bench["counts"]))
        self.assertGreaterEqual(bench["seconds"], 0)
        rows = pathlib.Path(self.path("l.csv")).read_text().splitlines()
        self.assertGreaterEqual(len(rows), bench["voxels"])

    def test_ctrl_c_leaves_no_half_project(self):
        process = subprocess.Popen([str(BIN / "footwall"), "new", "big.footwall", "--synthetic", "faulted", "--size",
                                    "700x700x500", "--seed", "1"], cwd=self.folder, stderr=subprocess.PIPE)
        process.stderr.readline()  # the first progress line: it is at work
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=30), 130)
        process.stderr.close()
        self.assertEqual(list(self.folder.rglob("*.h5")), [])
        self.assertFalse((self.folder / "big.footwall").exists())


if __name__ == "__main__":
    unittest.main()

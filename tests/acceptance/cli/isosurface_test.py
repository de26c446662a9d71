"""footwall isosurface: the same surface for any number of ranks, in every format, and kind errors."""
import hashlib
import json
import os
import sys
import unittest

from support import FootwallTest


def digest(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


class Isosurface(FootwallTest):
    def test_files_and_numbers_do_not_depend_on_ranks_or_pillars(self):
        project = self.synthetic()
        names = ("triangles", "vertices", "components", "closed_components", "genus", "euler", "area", "enclosed_volume",
                 "unit", "boundary_edges", "non_manifold_edges")
        seen = {}
        for ranks, pillars in ((1, "auto"), (2, "auto"), (3, "2x3"), (4, "1x1x2"), (7, "2x2x3")):
            for suffix in ("h5", "vtp"):
                out = f"s{ranks}.{suffix}"
                made = self.footwall("isosurface", project, "--value", "0.5", "--ranks", ranks, "--pillars", pillars,
                                     "--out", out)
                self.assertGreater(made["triangles"], 1000)
                self.assertEqual(made["ranks"], ranks)
                seen.setdefault(suffix, set()).add((digest(self.path(out)), json.dumps([made[name] for name in names])))
        self.assertEqual({suffix: len(some) for suffix, some in seen.items()}, {"h5": 1, "vtp": 1})

    def test_every_format_and_index_coordinates(self):
        project = self.synthetic()
        for suffix in ("vtp", "stl", "ply", "ts", "h5"):
            made = self.footwall("isosurface", project, "--value", "0.5", "--out", f"s.{suffix}", "--coordinates", "index")
            self.assertGreater(os.path.getsize(self.path(f"s.{suffix}")), 10 * made["triangles"])
        refused = self.refused(2, "isosurface", project, "--value", "0.5", "--out", "s.obj")
        self.assertIn(".h5", refused["hint"])

    def test_a_cap_closes_and_filters_keep(self):
        project = self.synthetic()
        opened = self.footwall("isosurface", project, "--value", "0.5")
        self.assertIsNone(opened["enclosed_volume"])
        self.assertGreater(opened["boundary_edges"]["at_border"], 0)
        self.assertEqual(opened["boundary_edges"]["inside"], 0)
        capped = self.footwall("isosurface", project, "--value", "0.5", "--cap", "--ranks", 3)
        self.assertEqual(capped["boundary_edges"], {"at_border": 0, "inside": 0})
        self.assertEqual(capped["closed_components"], capped["components"])
        self.assertTrue(0 < capped["enclosed_volume"] < 39 * 35 * 31)
        self.assertEqual(capped["unit"], "voxel")
        metric = self.footwall("isosurface", project, "--value", "0.5", "--cap", "--velocity", 2000)
        # 25 m between inlines, 12.5 m between crosslines, 4 ms of two-way time at 2000 m/s are 4 m.
        self.assertEqual(metric["unit"], "m")
        self.assertAlmostEqual(metric["enclosed_volume"] / capped["enclosed_volume"], 25 * 12.5 * 4, places=3)
        one = self.footwall("isosurface", project, "--value", "0.5", "--largest", 1, "--ranks", 2)
        self.assertEqual(one["components"], 1)
        some = self.footwall("isosurface", project, "--value", "0.5", "--min-area", 50)
        self.assertTrue(1 <= some["components"] < opened["components"])

    def test_a_value_that_no_sample_has_gives_an_empty_surface(self):
        project = self.synthetic()
        for suffix in ("h5", "vtp"):
            made = self.footwall("isosurface", project, "--value", "1e9", "--ranks", 2, "--out", f"none.{suffix}")
            self.assertEqual((made["triangles"], made["components"], made["area"]), (0, 0, 0))
            self.assertIn("run from", made["notices"][0])
            self.assertTrue(os.path.exists(self.path(f"none.{suffix}")))

    def test_kind_errors(self):
        project = self.synthetic()
        error = self.refused(1, "isosurface", project, "--value", "0", "--volume", "nothing")
        self.assertEqual(error["code"], "not_found")
        self.assertIn("amplitude", error["message"] + error["hint"])
        self.refused(2, "isosurface", project)
        self.refused(2, "isosurface", project, "--value", "nan")
        self.refused(2, "isosurface", project, "--value", "0", "--pillars", "0x1")
        self.refused(2, "isosurface", project, "--value", "0", "--coordinates", "screen")
        self.refused(2, "isosurface", project, "--value", "0", "--min-area", "-1")
        missing = self.refused(1, "isosurface", project, "--value", "0.5", "--out", "no such folder/s.h5")
        self.assertEqual(missing["code"], "not_found")

    def test_a_killed_engine_leaves_what_was_there(self):
        project = self.synthetic()
        self.footwall("isosurface", project, "--value", "0.5", "--out", "s.h5")
        before = digest(self.path("s.h5"))
        launcher = self.folder / "launcher.py"
        launcher.write_text("import json, os, pathlib, sys\n"
                            "output = pathlib.Path(json.load(open(sys.argv[-1]))['output'])\n"
                            "(output.parent / f'.{output.name}.partial-1-0').write_text('half')\n"
                            "os.kill(os.getpid(), 9)\n")
        listed = sorted(os.listdir(self.folder))
        done = self.start("isosurface", project, "--value", "0.4", "--out", "s.h5", "--json",
                          env={"FOOTWALL_LAUNCHER": f"{sys.executable} {launcher}"})
        self.assertEqual(json.loads(done.stdout)["error"]["code"], "engine")
        self.assertEqual(sorted(os.listdir(self.folder)), listed)
        self.assertEqual(digest(self.path("s.h5")), before)

    def test_the_bench_compares_ways_to_cut(self):
        ran = self.footwall("bench", "isosurface", "--ranks", 3, "--interleave", "2x2", "--pillars", "2x2x2", "--repeat", 1)
        self.assertEqual([row["pillars"] for row in ran["rows"]], ["1x1x1", "1x2x1", "2x1x1", "2x2x1", "2x2x2"])
        self.assertTrue(40000 < ran["triangles"] < 52000)
        redundant = [row["redundant_intersections"] for row in ran["rows"]]
        self.assertTrue(redundant[0] < redundant[3] < redundant[4])


if __name__ == "__main__":
    unittest.main()

"""--visible of isosurface and render: the same picture, the same files for any number of ranks, passes, budgets, errors."""
import hashlib
import json
import os
import unittest

from support import FootwallTest

PHASES = {"visibility", "partition", "assign", "extract", "composite"}


def digest(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


class Visible(FootwallTest):
    SMALL = ("--size", "160x120")
    CAMERA = ("--camera", "40,30,1")
    INSIDE = ("--camera", "10,20,5;400,300,0")
    MODES = ("depth", "paper")

    def check_passes(self, report):
        self.assertGreater(len(report["passes"]), 0)
        for each in report["passes"]:
            self.assertEqual(set(each["seconds"]), PHASES)
            self.assertGreaterEqual(each["load_difference"], 0)
            self.assertGreaterEqual(each["cells"], 1)
        self.assertEqual(sum(each["triangles"] for each in report["passes"]), report["triangles"])
        percents = [each["percent"] for each in report["passes"]]
        self.assertEqual(percents, sorted(percents))
        self.assertAlmostEqual(percents[-1], 100)
        self.assertEqual(report["uncovered_pixels"], report["passes"][-1]["uncovered_pixels"])

    # Pictures.

    def test_mode_depth_draws_the_picture_of_the_whole(self):
        project = self.synthetic()
        self.footwall("triangulate", project)
        for camera in (self.CAMERA, self.INSIDE, ("--azimuth", 200, "--elevation", -35)):
            draw = ("render", project, "--faults", "--section", "inline=middle", "--isosurface", "amplitude=0.5",
                    "--isosurface", "amplitude=-0.3,teal", *camera, *self.SMALL)
            whole = self.footwall(*draw, "--out", "whole.png", "--depth", "whole.tif", "--ranks", 2)
            triangles = set()
            for ranks in (1, 2, 3):
                made = self.footwall(*draw, "--visible", "--ranks", ranks, "--out", "seen.png", "--depth", "seen.tif")
                self.assertEqual(digest(self.path("seen.png")), digest(self.path("whole.png")), (camera, ranks))
                self.assertEqual(digest(self.path("seen.tif")), digest(self.path("whole.tif")), (camera, ranks))
                self.assertEqual((made["ranks"], made["mode"], made["notices"]), (ranks, "depth", whole["notices"]))
                for each, all_of_it in zip(made["isosurfaces"], whole["isosurfaces"]):
                    self.check_passes(each)
                    self.assertTrue(each["finished"])
                    self.assertEqual(each["uncovered_pixels"], 0)
                    self.assertTrue(0 < each["triangles"] < all_of_it["triangles"])
                triangles.add(tuple(each["triangles"] for each in made["isosurfaces"]))
            self.assertEqual(len(triangles), 1)

    def test_mode_paper_does_not_depend_on_ranks_or_threads(self):
        project = self.synthetic()
        draw = ("render", project, "--isosurface", "amplitude=0.5", "--isosurface", "amplitude=-0.3", *self.CAMERA,
                *self.SMALL, "--visible", "--mode", "paper")
        seen = set()
        for ranks, threads in ((1, 1), (2, 1), (3, 2)):
            made = self.footwall(*draw, "--ranks", ranks, "--threads", threads, "--out", "p.png")
            self.assertEqual(made["mode"], "paper")
            for each in made["isosurfaces"]:
                self.check_passes(each)
            counts = [[each["triangles"] for each in one["passes"]] for one in made["isosurfaces"]]
            seen.add((digest(self.path("p.png")), json.dumps(counts)))
        self.assertEqual(len(seen), 1)
        coarse = self.footwall(*draw, "--cell", 16, "--estimate-cell", "4x4x8", "--out", "p.png")
        self.assertLess(coarse["isosurfaces"][0]["passes"][0]["cells"], made["isosurfaces"][0]["passes"][0]["cells"])

    def test_passes_and_budgets_end_a_picture_that_can_be_used(self):
        project = self.synthetic()
        for mode in self.MODES:
            draw = ("render", project, "--isosurface", "amplitude=0.5", *self.CAMERA, *self.SMALL, "--visible", "--mode",
                    mode, "--ranks", 2, "--out", "p.png")
            whole = self.footwall(*draw)
            passes = len(whole["isosurfaces"][0]["passes"])
            self.assertGreater(passes, 1)
            for how, limit in ((("--passes", 1), "--passes"), (("--budget", 0.0001), "--budget")):
                one = self.footwall(*draw, *how)
                seen, = one["isosurfaces"]
                self.check_passes(seen)
                self.assertEqual(len(seen["passes"]), 1)
                self.assertFalse(seen["finished"])
                self.assertTrue(0 < seen["triangles"] < whole["isosurfaces"][0]["triangles"])
                self.assertIn(limit, one["notices"][0])
                self.assertIn(f"{seen['uncovered_pixels']} pixels", one["notices"][0])
                done = self.start(*draw, *how)
                self.assertEqual(done.returncode, 0)
                self.assertIn("not finished", done.stderr)
            both = self.footwall(*draw, "--isosurface", "amplitude=-0.3", "--budget", 0.0001)
            self.assertEqual([len(each["passes"]) for each in both["isosurfaces"]], [1, 1])
            self.assertEqual(len(both["notices"]), 2)
            enough = self.footwall(*draw, "--passes", passes, "--budget", 1e9)
            self.assertTrue(enough["isosurfaces"][0]["finished"])
            self.assertEqual(enough["notices"], [])

    def test_pass_images_end_with_the_picture(self):
        project = self.synthetic()
        for mode in self.MODES:
            made = self.footwall("render", project, "--section", "z=last", "--isosurface", "amplitude=0.5", "--isosurface",
                                 "amplitude=-0.3", *self.CAMERA, *self.SMALL, "--visible", "--mode", mode, "--ranks", 2,
                                 "--pass-images", f"new/{mode}", "--out", "p.png")
            passes = sum(len(each["passes"]) for each in made["isosurfaces"])
            names = [f"pass-{n:03}.png" for n in range(1, passes + 1)]
            self.assertEqual(sorted(os.listdir(self.path(f"new/{mode}"))), names)
            self.assertEqual(made["pass_images"], [f"new/{mode}/{name}" for name in names])
            pictures = [digest(self.path(path)) for path in made["pass_images"]]
            self.assertEqual(pictures[-1], digest(self.path("p.png")))
            self.assertNotEqual(pictures[0], pictures[-1])

    # Surfaces.

    def test_files_do_not_depend_on_ranks(self):
        project = self.synthetic()
        whole = self.footwall("isosurface", project, "--value", "0.5")
        for mode in self.MODES:
            seen = set()
            for ranks in (1, 2, 3):
                for suffix in ("h5", "vtp"):
                    made = self.footwall("isosurface", project, "--value", "0.5", "--visible", "--mode", mode, *self.CAMERA,
                                         *self.SMALL, "--ranks", ranks, "--out", f"s.{suffix}")
                    self.check_passes(made)
                    self.assertEqual((made["mode"], made["ranks"], made["finished"]), (mode, ranks, True))
                    self.assertNotIn("pillars", made)
                    self.assertTrue(0 < made["triangles"] < whole["triangles"])
                    self.assertTrue(0 < made["area"] < whole["area"])
                    self.assertEqual(made["non_manifold_edges"], 0)
                    seen.add((suffix, digest(self.path(f"s.{suffix}")),
                              json.dumps([made[name] for name in ("triangles", "vertices", "components", "area", "euler")])))
            self.assertEqual(len(seen), 2, mode)

    def test_the_file_holds_what_the_picture_shows(self):
        project = self.synthetic()
        self.footwall("render", project, "--section", "z=last", "--camera", "70,20,1.2", "--exaggeration", 2, "--save-view",
                      "from the east", *self.SMALL, "--out", "p.png")
        for mode in self.MODES:
            view = ("--camera", "from the east", *self.SMALL, "--visible", "--mode", mode, "--ranks", 2)
            drawn = self.footwall("render", project, "--isosurface", "amplitude=0.5", *view, "--out", "p.png")
            made = self.footwall("isosurface", project, "--value", 0.5, *view, "--pass-images", "passes")
            self.assertEqual(made["triangles"], drawn["isosurfaces"][0]["triangles"])
            self.assertEqual(digest(self.path(made["pass_images"][-1])), digest(self.path("p.png")))
            words = self.start("isosurface", project, "--value", 0.5, *view)
            self.assertEqual(words.returncode, 0, words.stderr)
            self.assertIn("uncovered", words.stdout)
        other = self.footwall("isosurface", project, "--value", 0.5, *view, "--exaggeration", 5)
        self.assertNotEqual(other["triangles"], made["triangles"])

    def test_nothing_to_see_is_no_error(self):
        project = self.synthetic()
        for mode in self.MODES:
            for value, camera in ((1e9, self.CAMERA), (0.5, ("--camera", "9000,9000,9000;18000,18000,18000"))):
                view = ("--visible", "--mode", mode, *camera, *self.SMALL, "--ranks", 2)
                made = self.footwall("isosurface", project, "--value", value, *view, "--out", "none.h5")
                self.assertEqual((made["triangles"], made["vertices"], made["finished"]), (0, 0, True))
                self.footwall("render", project, "--isosurface", f"amplitude={value}", *view, "--out", "none.png")

    def test_thin_surveys(self):
        for size in ("1x20x20", "9x1x1", "2x2x30"):
            project = self.synthetic(f"s{size}.footwall", size)
            for mode in self.MODES:
                view = ("--visible", "--mode", mode, *self.CAMERA, *self.SMALL, "--ranks", 3)
                whole = self.footwall("isosurface", project, "--value", 0)
                made = self.footwall("isosurface", project, "--value", 0, *view)
                self.assertLessEqual(made["triangles"], whole["triangles"])

    def test_errors_name_what_is_wrong(self):
        project = self.synthetic()
        surface = ("isosurface", project, "--value", "0.5")
        draw = ("render", project, "--isosurface", "amplitude=0.5", *self.SMALL, "--out", "p.png")
        for command in (surface, draw):
            for option in (("--mode", "depth"), ("--budget", 20), ("--passes", 2), ("--cell", 8), ("--estimate-cell", 2),
                           ("--pass-images", "d")):
                error = self.refused(2, *command, *option)
                self.assertIn(option[0], error["message"])
                self.assertIn("--visible", error["hint"])
            seen = (*command, *self.CAMERA, "--visible")
            self.assertIn("paper", self.refused(2, *seen, "--mode", "magic")["hint"])
            for budget in (0, -1, "nan", "inf"):
                self.refused(2, *seen, f"--budget={budget}")
            for passes in (0, -1):
                self.refused(2, *seen, f"--passes={passes}")
            self.assertIn("--mode paper", self.refused(2, *seen, "--cell", 8)["hint"])
            self.assertIn("--mode paper", self.refused(2, *seen, "--mode", "depth", "--estimate-cell", 8)["hint"])
            for cell in (0, -3, "8x8", "a", "8x0x8", 1 << 40):
                self.refused(2, *seen, "--mode", "paper", f"--cell={cell}")
            with open(self.path("file"), "w") as file:
                file.write("here\n")
            self.assertIn("folder", self.refused(2, *seen, "--pass-images", "file")["message"])
        self.assertIn("--camera", self.refused(2, *surface, "--visible")["hint"])
        for option in (self.CAMERA, ("--size", "100x100"), ("--exaggeration", 2)):
            self.assertIn("--visible", self.refused(2, *surface, *option)["hint"])
        for option in (("--cap",), ("--largest", 1), ("--min-area", 2), ("--pillars", "2x2"), ("--variant", "plane")):
            self.assertIn(option[0], self.refused(2, *surface, "--visible", *self.CAMERA, *option)["message"])
        self.refused(2, *surface, "--visible", "--camera", "1,2,3,4")
        self.refused(2, *surface, "--visible", *self.CAMERA, "--size", "9000x9000")
        self.refused(1, *surface, "--visible", "--camera", "no such view")
        self.assertIn("--isosurface",
                      self.refused(2, "render", project, "--section", "z=last", "--visible", "--out", "p.png")["hint"])


if __name__ == "__main__":
    unittest.main()

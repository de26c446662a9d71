"""Contrast, offset, numbers of whole faults, filtered values, discontinuity volumes, and how good they are."""
import csv
import json
import math
import sys
import unittest

from support import FootwallTest


def faces(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class Attributes(FootwallTest):
    def test_contrast_is_there_by_default_and_offset_on_request(self):
        project = self.synthetic()
        run = self.footwall("extract", project, "--ranks", 2)
        self.footwall("faces", project, "--csv", "plain.csv")
        rows = faces(self.path("plain.csv"))
        self.assertTrue(any(row["contrast"] for row in rows))
        self.assertFalse(any(row["offset_voxels"] or row["offset"] for row in rows))
        ranked = self.footwall("faces", project, "--top", 5)["faces"]
        contrasts = [row["contrast"] for row in ranked]
        self.assertEqual(contrasts, sorted(contrasts))
        self.assertTrue(all(row["count"] >= 30 for row in ranked))

        for ranks, exchange in ((1, "minimum"), (3, "reduce"), (4, "auto"), (7, "reduce")):
            same = self.footwall("extract", project, "--ranks", ranks, "--exchange", exchange)
            self.assertEqual((same["checksum"], same["faults"]), (run["checksum"], run["faults"]))

    def test_offsets_in_metres_are_those_in_voxels_along_the_normal(self):
        project = self.synthetic()
        self.footwall("extract", project, "--compute", "offset", "--velocity", 2000)
        self.footwall("faces", project, "--csv", "f.csv")
        found = 0
        for row in faces(self.path("f.csv")):
            self.assertEqual(row["contrast"], "")
            if row["offset_voxels"] == "":
                self.assertEqual((row["offset"], row["offset_score"]), ("", ""))
                continue
            voxels = float(row["offset_voxels"])
            self.assertIn(voxels, range(-8, 9))
            self.assertTrue(0 <= float(row["offset_score"]) <= 1)
            # 25 m between inlines, 12.5 m between crosslines, 4 ms of two-way time at 2000 m/s are 4 m.
            metres = math.hypot(25 * float(row["normal_i"]), 12.5 * float(row["normal_j"]), 4 * float(row["normal_k"]))
            self.assertAlmostEqual(float(row["offset"]), voxels * metres, places=6)
            found += voxels != 0
        self.assertGreater(found, 3)
        self.footwall("extract", project, "--compute", "offset")
        self.footwall("faces", project, "--csv", "time.csv")
        rows = faces(self.path("time.csv"))
        self.assertFalse(any(row["offset"] for row in rows))
        self.assertTrue(any(row["offset_voxels"] for row in rows))
        # A ranking has the number that it goes by; where no face has one it says what may be missing.
        self.assertIn(" offset_voxels ", self.start("faces", project, "--highest", "offset_voxels").stdout)
        self.assertIn("--velocity", self.start("faces", project, "--highest", "offset").stdout)

    def test_whole_faults_count_each_voxel_once(self):
        project = self.synthetic()
        run = self.footwall("extract", project)
        self.footwall("faces", project, "--csv", "f.csv")
        self.assertEqual([fault["name"] for fault in run["faults"]], ["planar", "listric", "twisted"])
        for fault in run["faults"]:
            rows = [row for row in faces(self.path("f.csv")) if row["fault"] == fault["name"]]
            self.assertEqual(fault["faces"], len(rows))
            summed = sum(int(row["count"]) for row in rows)
            self.assertTrue(0 < fault["count"] < summed)
            self.assertGreaterEqual(fault["count"], max(int(row["count"]) for row in rows))
            self.assertEqual(fault["min"], min(float(row["min"]) for row in rows if row["min"]))
            self.assertEqual(fault["max"], max(float(row["max"]) for row in rows if row["max"]))
            self.assertTrue(0 < fault["discontinuity"] < 1)
        one = self.footwall("faces", project, "--fault", "listric")["faults"]
        self.assertEqual(one, [fault for fault in run["faults"] if fault["name"] == "listric"])
        self.assertEqual(self.footwall("info", project)["runs"][0]["faults"], run["faults"])

    def test_a_discontinuity_volume_is_the_same_for_any_number_of_ranks(self):
        project = self.synthetic()
        made = self.footwall("attribute", project, "--ranks", 1)
        self.assertEqual((made["role"], made["window"], made["dims"]), ("discontinuity", "3x3x9", [40, 36, 32]))
        self.assertTrue(0 <= made["min"] < made["mean"] < made["max"] <= 1)
        for ranks in (2, 3, 7):
            other = self.footwall("attribute", project, "--ranks", ranks, "--name", f"by {ranks}", "--volume", made["of"])
            self.assertEqual(other["checksum"], made["checksum"])
        volumes = {volume["name"]: volume for volume in self.footwall("info", project, "--verify")["volumes"]}
        self.assertEqual(len(volumes), 5)
        self.assertEqual((volumes["by 3"]["role"], volumes["by 3"]["high_is"]), ("discontinuity", "fault"))
        self.assertIsNone(volumes[made["of"]]["high_is"])
        # What it is made of can be extracted from, as any volume.
        self.footwall("extract", project, "--volume", "by 3")

        self.assertEqual(self.refused(1, "attribute", project, "--name", "by 3")["code"], "invalid")
        self.assertEqual(self.refused(2, "attribute", project, "--window", "2x3x9")["code"], "usage")
        self.assertEqual(self.refused(2, "attribute", project, "--kind", "curvature")["code"], "usage")
        self.assertEqual(self.refused(1, "attribute", project, "--volume", "nothing")["code"], "not_found")
        self.assertEqual(len(self.footwall("info", project)["volumes"]), 5)

    def test_a_killed_engine_leaves_no_part_of_a_volume(self):
        project = self.synthetic()
        folder = self.folder / "s.footwall.volumes"
        before = sorted(folder.iterdir())
        # Ends as mpirun does whose ranks are killed in the middle of the file.
        launcher = self.folder / "launcher.py"
        launcher.write_text("import json, os, pathlib, sys\n"
                            "output = pathlib.Path(json.load(open(sys.argv[-1]))['output'])\n"
                            "(output.parent / f'.{output.name}.partial-1-0').write_text('half')\n"
                            "os.kill(os.getpid(), 9)\n")
        done = self.start("attribute", project, "--json", env={"FOOTWALL_LAUNCHER": f"{sys.executable} {launcher}"})
        self.assertEqual(json.loads(done.stdout)["error"]["code"], "engine")
        self.assertEqual(sorted(folder.iterdir()), before)
        self.assertEqual(len(self.footwall("info", project)["volumes"]), 1)

    def test_an_imported_volume_says_what_it_is(self):
        project = self.synthetic()
        self.footwall("export", project, "--raw", "v.raw")
        self.footwall("import", "volume", project, "v.raw", "--raw", "--dims", "40x36x32", "--name", "coherence",
                      "--role", "discontinuity", "--high-is", "continuous")
        volumes = {volume["name"]: volume for volume in self.footwall("info", project)["volumes"]}
        self.assertEqual((volumes["coherence"]["role"], volumes["coherence"]["high_is"]), ("discontinuity", "continuous"))
        error = self.refused(2, "import", "volume", project, "v.raw", "--raw", "--dims", "40x36x32", "--name", "x",
                             "--high-is", "continuous")
        self.assertIn("--role", error["hint"])

    def test_filtered_values_need_voxels_to_be_moved(self):
        project = self.synthetic()
        self.footwall("extract", project, "--compute", "filter", "--filter", "sharpen=1,8", "--ranks", 2)
        self.assertEqual(self.refused(2, "extract", project, "--compute", "filter", "--filter", "blur")["code"], "usage")
        error = self.refused(2, "extract", project, "--compute", "filter", "--exchange", "reduce")
        self.assertIn("filter", error["message"])

    def test_quality_is_measured_on_known_faults(self):
        done = self.footwall("bench", "quality", "--size", "96x96x96", "--volumes", 1, "--faces", 30, "--legs", "16")
        (leg,) = done["legs"]
        self.assertEqual(leg["leg"], 16)
        self.assertGreater(leg["pairs"], 50)
        self.assertGreater(leg["contrast"], 0.75)  # the whole measurement asks 0.85
        self.assertGreater(leg["contrast"], leg["variance"])
        self.assertEqual(self.refused(2, "bench", "quality", "--legs", "2")["code"], "usage")
        self.assertEqual(self.refused(2, "bench", "quality", "--size", "8x8x8")["code"], "usage")


if __name__ == "__main__":
    unittest.main()

"""EXTRACT-ALL through the programs: the same numbers whatever the ranks, threads, strategy and SIMD path, and the right ones."""
import array
import csv
import itertools
import json
import os
import unittest

from oracle import Volume, statistics
from support import FootwallTest


def faces(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def number(text):
    return None if text == "" else float(text)


def triangle(row):
    return [tuple(round(256 * float(row[f"{axis}{corner}"])) for axis in "xyz") for corner in range(3)]


class Extract(FootwallTest):
    def prepared(self, size="40x36x32"):
        project = self.synthetic(size=size)
        self.footwall("triangulate", project)
        return project

    def test_same_checksum_for_every_way_of_computing(self):
        project = self.prepared()
        wanted = self.footwall("extract", project, "--ranks", 1, "--exchange", "reduce")
        self.assertGreater(wanted["faces"], 50)
        self.assertGreater(wanted["voxels"], 1000)
        for ranks, exchange in itertools.product((1, 2, 3, 4, 7), ("reduce", "minimum", "push")):
            run = self.footwall("extract", project, "--ranks", ranks, "--exchange", exchange)
            self.assertEqual((run["checksum"], run["ranks"], run["exchange"]), (wanted["checksum"], ranks, exchange))
        self.assertEqual(self.footwall("extract", project, "--threads", 3)["checksum"], wanted["checksum"])
        for path in ("baseline", "avx2", "avx512"):
            run = self.footwall("extract", project, "--ranks", 2, env={"FOOTWALL_SIMD": path})
            self.assertEqual(run["checksum"], wanted["checksum"], path)

    def test_keys_that_scripts_rely_on(self):
        run = self.footwall("extract", self.prepared(), "--ranks", 2)
        for key in ("run", "volume", "faces", "voxels", "ranks", "threads", "exchange", "balance", "seconds", "bytes_sent",
                    "messages", "load_max_over_mean", "checksum"):
            self.assertIn(key, run)
        self.assertEqual(set(run["seconds"]), {"read", "balance", "voxelize", "exchange", "compute", "total"})
        self.assertNotIn("auto", (run["exchange"], run["balance"]))
        self.assertGreater(run["bytes_sent"], 0)

    def test_statistics_equal_the_definition(self):
        project = self.prepared("24x20x18")
        self.footwall("extract", project, "--ranks", 2)
        self.footwall("faces", project, "--csv", "f.csv", "--coordinates", "index")
        self.footwall("export", project, "--raw", "v.raw")
        values = array.array("f")
        with open(self.path("v.raw"), "rb") as file:
            values.frombytes(file.read())
        volume = Volume(values.tolist(), (24, 20, 18))
        rows = faces(self.path("f.csv"))
        self.assertGreater(len(rows), 10)
        self.assertEqual(len({(row["fault"], row["face"]) for row in rows}), len(rows))
        for row in rows:
            self.assertRegex(row["face"], r"^\d+-\d+\.\d+$")  # pillar-pillar.number
        for row in rows[:: max(1, len(rows) // 40)]:
            expected = statistics(triangle(row), volume)
            found = {key: number(row[key]) for key in expected}
            self.assertEqual(found, expected, row["face"])

    def test_stale_faults_are_triangulated_first_and_it_says_so(self):
        project = self.synthetic()
        done = self.start("extract", project, "--ranks", 1)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("triangulat", done.stderr)

    def test_faces_outside_the_survey_count_only_voxels_inside(self):
        project = self.prepared()
        survey = self.footwall("info", project)["survey"]
        first = survey["inlines"]["first"] - 30 * survey["inlines"]["step"]
        crosslines = survey["crosslines"]
        z0, interval = survey["z0"], survey["interval"]
        lines = [{"op": "add", "what": "fault", "name": "out"}]
        for inline in (first, first + 20 * survey["inlines"]["step"], first + 45 * survey["inlines"]["step"]):
            lines.append({"op": "add", "what": "pillar", "fault": "out", "nodes": [
                {"inline": inline, "crossline": crosslines["first"] + 10, "z": z0 + 3 * interval},
                {"inline": inline, "crossline": crosslines["first"] + 18, "z": z0 + 25 * interval}]})
        done = self.start("edit", project, stdin="\n".join(map(json.dumps, lines)))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.footwall("extract", project, "--ranks", 3)
        self.footwall("faces", project, "--fault", "out", "--csv", "out.csv")
        outside = {row["outside"] for row in faces(self.path("out.csv"))}
        self.assertEqual(outside, {"0", "1", "2"})
        for row in faces(self.path("out.csv")):
            if row["outside"] == "2":
                self.assertEqual((row["count"], row["mean"], row["variance"]), ("0", "", "0"))

    def test_what_is_not_built_is_refused_with_the_reason(self):
        project = self.prepared()
        for option, value in (("--balance", "sideways"), ("--voxelizer", "gpu"), ("--compute", "sideways")):
            error = self.refused(2, "extract", project, option, value)
            self.assertEqual(error["code"], "usage")
            self.assertIn(value, error["message"])

    def test_a_damaged_volume_is_an_error_on_every_rank_and_no_hang(self):
        project = self.prepared()
        volumes = self.folder / "s.footwall.volumes"
        (volume,) = list(volumes.glob("*.h5"))
        data = bytearray(volume.read_bytes())
        middle = len(data) // 2
        data[middle:middle + 4096] = os.urandom(4096)
        volume.write_bytes(data)
        error = self.refused(1, "extract", project, "--ranks", 3)
        self.assertEqual(error["code"], "corrupt")

    def test_an_engine_that_cannot_start_is_explained(self):
        project = self.prepared()
        done = self.start("extract", project, env={"FOOTWALL_LAUNCHER": "/no/such/mpirun"})
        self.assertEqual(done.returncode, 1)
        self.assertIn("/no/such/mpirun", done.stderr)


if __name__ == "__main__":
    unittest.main()

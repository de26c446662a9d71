"""The voxels of faces, kept by a run and read back: exactly, and within a signal-to-noise ratio."""
import array
import csv
import itertools
import math
import sqlite3
import unittest

from support import FootwallTest


class FaceVoxels(FootwallTest):
    SIZE = (40, 36, 32)

    def setUp(self):
        super().setUp()
        self.project = self.synthetic(size="x".join(map(str, self.SIZE)))
        self.footwall("triangulate", self.project)

    def exported(self, *options):
        answer = self.footwall("export", self.project, "--face-voxels", "v.csv", *options)
        with open(self.path("v.csv"), newline="") as file:
            return answer["face_voxels"], list(csv.DictReader(file))

    def volume(self):
        self.footwall("export", self.project, "--raw", "v.raw")
        values = array.array("f")
        with open(self.path("v.raw"), "rb") as file:
            values.frombytes(file.read())
        _, crosslines, samples = self.SIZE
        return lambda i, j, k: values[(i * crosslines + j) * samples + k]

    def stored(self):
        """Every code of the last run, as SQLite has it."""
        connection = sqlite3.connect(self.path(self.project))
        rows = connection.execute("SELECT codec, fault, ends, data FROM face_voxels WHERE run = "
                                  "(SELECT max(id) FROM extraction) ORDER BY codec, fault").fetchall()
        connection.close()
        return rows

    def test_voxels_come_back_exactly(self):
        run = self.footwall("extract", self.project, "--compute", "variance,voxels", "--ranks", 2)
        told, rows = self.exported()
        self.assertEqual((told["codec"], told["voxels"], told["faces"]), ("voxels", run["voxels"], run["faces"]))
        self.assertEqual(len(rows), run["voxels"])
        at = self.volume()
        for row in rows:
            index = int(row["i"]), int(row["j"]), int(row["k"])
            self.assertEqual(array.array("f", [float(row["value"])])[0], at(*index))
        self.assertEqual(int(rows[0]["inline"]), 300 + int(rows[0]["i"]))
        self.assertEqual(float(rows[0]["z"]), 800 + 4 * int(rows[0]["k"]))
        counts = {}
        for row in rows:
            counts[row["fault"], row["face"]] = counts.get((row["fault"], row["face"]), 0) + 1
        self.footwall("faces", self.project, "--csv", "f.csv")
        with open(self.path("f.csv"), newline="") as file:
            for face in csv.DictReader(file):
                self.assertEqual(counts.get((face["fault"], face["face"]), 0), int(face["count"]) + int(face.get("nulls", 0)))

    def test_lot_keeps_the_ratio_in_a_fraction_of_the_bytes(self):
        at = self.volume()
        for order in ("1d", "2d", "1d=zero", "2d=tuned"):
            run = self.footwall("extract", self.project, "--compute", "lot", "--snr", 30, "--lot-order", order)
            told, rows = self.exported()
            self.assertEqual(told["codec"], "lot")
            wanted = [at(int(row["i"]), int(row["j"]), int(row["k"])) for row in rows]
            noise = sum((float(row["value"]) - value) ** 2 for row, value in zip(rows, wanted))
            signal = sum(value ** 2 for value in wanted)
            self.assertGreater(10 * math.log10(signal / noise), 29, order)
            self.assertLess(10 * math.log10(signal / noise), 36, order)
            self.assertLess(sum(len(row[3]) for row in self.stored()), run["voxels"] * 1.5, order)

    def test_the_same_bytes_for_every_way_of_computing(self):
        wanted = None
        for ranks, exchange in itertools.product((1, 2, 3), ("auto", "minimum")):
            self.footwall("extract", self.project, "--compute", "lot,voxels", "--snr", 35, "--ranks", ranks,
                          "--exchange", exchange, "--threads", ranks)
            wanted = wanted or self.stored()
            self.assertEqual({row[0] for row in wanted}, {"lot", "voxels"})
            self.assertEqual(self.stored(), wanted)
        for path in ("baseline", "avx2"):
            self.footwall("extract", self.project, "--compute", "lot,voxels", "--snr", 35, env={"FOOTWALL_SIMD": path},
                          )
            self.assertEqual(self.stored(), wanted, path)

    def test_filtered_values_come_out_alike(self):
        self.footwall("extract", self.project, "--compute", "voxels")
        _, plain = self.exported()
        self.footwall("extract", self.project, "--compute", "filter", "--filter", "sharpen=1,8")
        answer, filtered = self.exported()
        self.assertEqual(answer["codec"], "filter")
        places = ("fault", "face", "i", "j", "k")
        self.assertEqual([[row[p] for p in places] for row in plain], [[row[p] for p in places] for row in filtered])
        self.assertNotEqual([row["value"] for row in plain], [row["value"] for row in filtered])

    def test_a_job_elsewhere_brings_them_too(self):
        self.footwall("extract", self.project, "--compute", "lot", "--snr", 30)
        wanted = self.stored()
        self.footwall("extract", self.project, "--compute", "lot", "--snr", 30, "--write-job", "job")
        self.footwall("batch", "job/JOB.json", "--ranks", 2)
        self.footwall("attach", self.project, "job")
        self.assertEqual(self.stored(), wanted)

    def test_what_cannot_be_is_refused_with_the_reason(self):
        error = self.refused(2, "extract", self.project, "--compute", "lot", "--exchange", "reduce")
        self.assertIn("push", error["hint"])
        self.refused(2, "extract", self.project, "--compute", "lot", "--snr", 300)
        self.refused(2, "extract", self.project, "--compute", "lot", "--snr", 30, "--lot-order", "3d")
        for option in (("--snr", 30), ("--lot-order", "1d"), ("--filter", "sharpen=1,8")):
            error = self.refused(2, "extract", self.project, "--compute", "variance", *option)
            self.assertIn("--compute", error["hint"])
        self.footwall("extract", self.project, "--compute", "variance,lot")  # the transform alone
        error = self.refused(1, "export", self.project, "--face-voxels", "v.csv")
        self.assertIn("--compute lot --snr", error["hint"])
        self.assertFalse((self.folder / "v.csv").exists())

    def test_a_damaged_code_is_named_and_leaves_no_file(self):
        self.footwall("extract", self.project, "--compute", "lot", "--snr", 30)
        connection = sqlite3.connect(self.path(self.project))
        with connection:
            connection.execute("UPDATE face_voxels SET data = zeroblob(length(data))")
        connection.close()
        self.assertEqual(self.refused(1, "export", self.project, "--face-voxels", "v.csv")["code"], "corrupt")
        self.assertFalse((self.folder / "v.csv").exists())


if __name__ == "__main__":
    unittest.main()

"""footwall bench isosurface: variants, tables, files and sweeps."""
import array
import math
import sys
import unittest

from support import FootwallTest


class BenchIsosurface(FootwallTest):
    def bench(self, *arguments):
        return self.footwall("bench", "isosurface", "--repeat", 2, *arguments)

    def raw(self, name, dims, value):
        """A raw volume, x the fastest, of value(x, y, z)."""
        nx, ny, nz = dims
        samples = array.array("f", (value(x, y, z) for z in range(nz) for y in range(ny) for x in range(nx)))
        if sys.byteorder == "big":
            samples.byteswap()
        with open(self.path(name), "wb") as file:
            samples.tofile(file)
        return name

    def test_all_variants_find_the_ball(self):
        ball = self.raw("ball.raw", (20, 24, 30), lambda x, y, z: 7 - math.hypot(x - 9.4, y - 11.7, z - 15.2))
        answers = [self.bench("--raw", ball, "--dims", "20,24,30", "--value", 0, "--variant", variant)
                   for variant in ("bricks", "cubes", "plane", "vector")]
        for answer in answers:
            self.assertEqual(answer["dims"], [20, 24, 30])
            self.assertEqual((answer["euler"], answer["components"], answer["boundary_edges"]), (2, 1, 0))
            self.assertEqual(answer["boundary_edges_at_border"], 0)
            self.assertAlmostEqual(answer["enclosed_volume"] / (4 / 3 * math.pi * 343), 1, delta=0.04)
            self.assertEqual(len(answer["seconds"]), 2)
            self.assertEqual(len(answer["seconds_reused"]), 2)
            self.assertGreater(answer["triangles"], 1000)
            self.assertGreaterEqual(answer["peak_mib"], 0)
            self.assertIsNotNone(answer["checked_against"])
            for key in ("triangles", "vertices", "area"):
                self.assertEqual(answer[key], answers[0][key])

    def test_the_pyramid_changes_nothing_but_the_time(self):
        plain = self.bench("--synthetic", "sphere", "--size", 64)
        skipping = self.bench("--synthetic", "sphere", "--size", 64, "--pyramid", "--threads", 2, "--no-normals")
        for key in ("triangles", "vertices", "euler", "area"):
            self.assertEqual(plain[key], skipping[key])
        self.assertLess(skipping["bricks_active"], 0.5)
        self.assertIsNone(plain["bricks_active"])

    def test_without_a_check_it_says_so(self):
        answer = self.bench("--synthetic", "gyroid", "--size", 24, "--no-check")
        self.assertIsNone(answer["checked_against"])
        words = self.start("bench", "isosurface", "--synthetic", "gyroid", "--size", 24, "--no-check", "--repeat", 1)
        self.assertIn("NOT compared", words.stdout)

    def test_the_seeds_tables_are_counted(self):
        # No two neighbours alike: every cell is ambiguous.
        state = [1]

        def noise(x, y, z):
            state[0] = (state[0] * 1103515245 + 12345) % 2**31
            return state[0] / 2**30 - 1

        noise_file = self.raw("noise.raw", (14, 13, 12), noise)
        right, first, second = (
            self.bench("--raw", noise_file, "--dims", "14x13x12", "--value", 0, "--variant", variant, "--tables", tables)
            for variant, tables in (("vector", "trilinear"), ("plane", "seed"), ("cubes", "seed")))
        self.assertEqual(right["boundary_edges"], 0)
        self.assertIsNone(right["cells_decided_otherwise"])
        self.assertEqual((first["tables"], second["tables"]), ("seed000", "seed002"))
        self.assertGreater(first["cells_decided_otherwise"], 0)
        self.assertGreater(second["cells_decided_otherwise"], first["cells_decided_otherwise"])
        self.assertGreater(second["boundary_edges"], 0)
        self.assertEqual(first["undecided_cells"], second["undecided_cells"])

    def test_a_sweep_compares_vector_with_cubes(self):
        answer = self.bench("--synthetic", "sphere", "--size", 32, "--sweep", "-3:3:3")
        self.assertEqual([row["value"] for row in answer["rows"]], [-3, 0, 3])
        for row in answer["rows"]:
            self.assertAlmostEqual(row["gain"], row["cubes_seconds"] / row["vector_seconds"], places=6)
            self.assertGreater(row["triangles"], 100)

    def test_a_written_volume_gives_the_same_surface(self):
        made = self.bench("--synthetic", "envelope", "--size", 32, "--write-raw", "envelope.raw")
        read = self.bench("--raw", "envelope.raw", "--dims", "32,32,32", "--value", made["value"])
        for key in ("triangles", "vertices", "area", "euler"):
            self.assertEqual(made[key], read[key])

    def test_wrong_options_are_refused(self):
        file = self.raw("small.raw", (4, 4, 4), lambda x, y, z: x)
        self.assertIn("--raw", self.refused(2, "bench", "isosurface")["hint"])
        self.assertIn("--dims", self.refused(2, "bench", "isosurface", "--raw", file, "--value", 1)["hint"])
        self.assertIn("--value", self.refused(2, "bench", "isosurface", "--raw", file, "--dims", "4,4,4")["hint"])
        self.assertEqual(self.refused(1, "bench", "isosurface", "--raw", file, "--dims", "4,4,5", "--value", 1)["code"],
                         "format")
        sphere = ("bench", "isosurface", "--synthetic", "sphere", "--size", 8)
        self.assertIn("bricks", self.refused(2, *sphere, "--variant", "cubes", "--threads", 2)["hint"])
        self.assertIn("bricks", self.refused(2, *sphere, "--variant", "plane", "--pyramid")["hint"])
        self.assertIn("cubes", self.refused(2, *sphere, "--tables", "seed")["hint"])
        self.assertIn("seed000", self.refused(2, *sphere, "--variant", "plane", "--tables", "mine")["hint"])
        self.assertIn("vector", self.refused(2, *sphere, "--variant", "octree")["hint"])
        self.assertIn("gyroid", self.refused(2, "bench", "isosurface", "--synthetic", "cube")["hint"])
        self.refused(2, *sphere, "--sweep", "1:2")
        self.refused(2, *sphere, "--repeat", 0)


if __name__ == "__main__":
    unittest.main()

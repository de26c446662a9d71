"""footwall render with isosurfaces, and bench render: the same picture for any number of ranks, depth, cameras, errors."""
import hashlib
import struct
import unittest

from support import FootwallTest


def digest(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def floats_of_tiff(path):
    """(width, height, values) of a little-endian TIFF of one float32 strip."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:4] == b"II*\0"
    at, = struct.unpack_from("<I", data, 4)
    count, = struct.unpack_from("<H", data, at)
    tags = {}
    for n in range(count):
        tag, kind, _, value = struct.unpack_from("<HHII", data, at + 2 + 12 * n)
        tags[tag] = value & 0xffff if kind == 3 else value
    assert tags[258] == 32 and tags[259] == 1 and tags[339] == 3 and tags[277] == 1
    width, height = tags[256], tags[257]
    assert tags[279] == 4 * width * height
    return width, height, struct.unpack_from(f"<{width * height}f", data, tags[273])


class RenderIsosurface(FootwallTest):
    SMALL = ("--size", "160x120")

    def test_the_picture_does_not_depend_on_ranks_or_groups(self):
        project = self.synthetic()
        self.footwall("triangulate", project)
        seen = set()
        for ranks, threshold in ((1, 0.1), (2, 0), (3, 1e9), (4, 0.1), (7, 10), (1, "auto"), (2, "auto"), (3, "auto"),
                                 (4, "auto"), (7, "auto")):
            made = self.footwall("render", project, "--faults", "--section", "inline=middle", "--isosurface",
                                 "amplitude=0.5", "--isosurface", "amplitude=-0.5,teal", "--ranks", ranks,
                                 "--group-threshold", threshold, *self.SMALL, "--out", "p.png", "--depth", "p.tif")
            self.assertEqual(made["ranks"], ranks)
            self.assertEqual([each["name"] for each in made["isosurfaces"]], ["amplitude = 0.5", "amplitude = -0.5"])
            self.assertTrue(all(each["triangles"] > 1000 for each in made["isosurfaces"]))
            seen.add((digest(self.path("p.png")), digest(self.path("p.tif"))))
        self.assertEqual(len(seen), 1)

    def test_depth_is_between_the_planes_and_nearer_where_an_isosurface_is(self):
        project = self.synthetic()
        common = ("--section", "inline=last", "--camera", "35,20,1", *self.SMALL, "--ranks", 2)
        self.footwall("render", project, *common, "--out", "a.png", "--depth", "a.tif")
        self.footwall("render", project, *common, "--isosurface", "amplitude=0.5", "--out", "b.png", "--depth", "b.tif")
        width, height, without = floats_of_tiff(self.path("a.tif"))
        self.assertEqual((width, height), (160, 120))
        _, _, with_it = floats_of_tiff(self.path("b.tif"))
        self.assertTrue(all(0 <= value <= 1 for value in with_it))
        self.assertEqual(without[0], 1)
        self.assertTrue(all(b <= a for a, b in zip(without, with_it)))
        self.assertGreater(sum(b < a for a, b in zip(without, with_it)), 500)

    def test_cameras(self):
        project = self.synthetic()
        draw = ("render", project, "--section", "z=middle", *self.SMALL)
        self.footwall(*draw, "--camera", "40,30,1.5", "--out", "a.png")
        self.footwall(*draw, "--azimuth", 40, "--elevation", 30, "--zoom", 1.5, "--out", "b.png")
        self.assertEqual(digest(self.path("a.png")), digest(self.path("b.png")))
        self.footwall(*draw, "--camera", "0,-3000,1500;0,0,0", "--out", "c.png", "--depth", "c.tif")
        _, _, depth = floats_of_tiff(self.path("c.tif"))
        self.assertLess(min(depth), 1)
        self.footwall(*draw, "--camera", "0,-3000,1500;0,0,0;0,0,1", "--out", "d.png")
        self.assertEqual(digest(self.path("c.png")), digest(self.path("d.png")))
        for words in ("1,2,3,4", "a,2", "0,0,0;1,2", "0,0,0;0,0,0", "0,0,5;0,0,0;0,0,1", "0,95,1"):
            self.refused(2, *draw, "--camera", words, "--out", "e.png")
        self.refused(2, *draw, "--camera", "0,0,1", "--zoom", 2, "--out", "e.png")
        self.assertIn("--save-view", self.refused(1, *draw, "--camera", "my view", "--out", "e.png")["hint"])

    def test_saved_views(self):
        project = self.synthetic()
        draw = ("render", project, "--section", "z=middle", *self.SMALL)
        self.assertEqual(self.footwall("views", project, "--json")["views"], [])
        self.refused(2, *draw, "--save-view", "front", "--out", "a.png")
        self.refused(1, *draw, "--camera", "40,30,1.5", "--save-view", " ", "--out", "a.png")
        self.footwall(*draw, "--camera", "40,30,1.5", "--exaggeration", 2, "--save-view", "front", "--out", "a.png")
        self.footwall(*draw, "--camera", "front", "--out", "b.png")
        self.assertEqual(digest(self.path("a.png")), digest(self.path("b.png")))
        self.footwall(*draw, "--camera", "front", "--exaggeration", 1, "--out", "c.png")
        self.assertNotEqual(digest(self.path("a.png")), digest(self.path("c.png")))
        self.footwall(*draw, "--camera", "10.25,-3000,1500;0,0,0", "--save-view", "2, from above", "--out", "d.png")
        self.footwall(*draw, "--camera", "2, from above", "--out", "e.png")
        self.assertEqual(digest(self.path("d.png")), digest(self.path("e.png")))
        views = self.footwall("views", project, "--json")["views"]
        self.assertEqual([view["name"] for view in views], ["2, from above", "front"])
        self.assertEqual([view["exaggeration"] for view in views], [None, 2])
        self.assertIn("front", self.refused(1, *draw, "--camera", "back", "--out", "f.png")["hint"])
        self.footwall("views", project, "--delete", "front")
        self.refused(1, "views", project, "--delete", "front")
        self.refused(1, *draw, "--camera", "front", "--out", "f.png")

    def test_errors_name_what_is_wrong(self):
        project = self.synthetic()
        draw = ("render", project, *self.SMALL, "--out", "p.png")
        self.refused(2, *draw)
        for words in ("amplitude", "=1", "amplitude=x", "amplitude=nan", "amplitude=1e99", "amplitude=1,2,3"):
            self.refused(2, *draw, "--isosurface", words)
        self.assertIn("sand", self.refused(2, *draw, "--isosurface", "amplitude=0.5,pinkish")["hint"])
        self.refused(1, *draw, "--isosurface", "nothing=0.5")
        self.refused(2, "render", project, "--size", "9000x9000", "--out", "p.png", "--isosurface", "amplitude=0")
        empty = self.footwall(*draw, "--isosurface", "amplitude=1e30,#102030", "--ranks", 2)
        self.assertEqual(empty["isosurfaces"][0]["triangles"], 0)
        self.assertIn("no triangles", empty["notices"][0])


class BenchRender(FootwallTest):
    def test_ranks_threads_and_groups_give_one_picture(self):
        pictures = set()
        for ranks, threads, threshold in ((1, 1, 0.1), (1, 3, 0.1), (2, 2, 0), (3, 1, 1e9), (5, 1, 0.1), (3, 2, "auto")):
            made = self.footwall("bench", "render", "--synthetic", "sphere", "--triangles", 40000, "--size", "256x200",
                                 "--ranks", ranks, "--threads", threads, "--group-threshold", threshold, "--repeat", 2)
            self.assertAlmostEqual(made["triangles"], 40000, delta=1000)
            self.assertEqual(len(made["seconds"]), 2)
            self.assertTrue(made["checked"])
            if threshold != "auto":
                self.assertEqual(made["merged_pixels"] > 0, ranks > 1 and threshold != 1e9)
            pictures.add(made["picture"])
        self.assertEqual(len(pictures), 1)

    def test_volumes_and_meshes(self):
        n = 24
        with open(self.path("ball.raw"), "wb") as file:
            for z in range(n):
                for y in range(n):
                    for x in range(n):
                        file.write(struct.pack("<f", (x - 11) ** 2 + (y - 12) ** 2 + (z - 11.5) ** 2))
        raw = ("bench", "render", "--raw", "ball.raw", "--dims", f"{n},{n},{n}", "--value", 70, "--size", "128x128",
               "--repeat", 1)
        made = [self.footwall(*raw, "--ranks", ranks, *pyramid) for ranks in (1, 3, 4, 7)
                for pyramid in ((), ("--pyramid",))]
        self.assertEqual(len({(each["picture"], each["triangles"]) for each in made}), 1)
        self.assertEqual([each["pyramid_seconds"] is None for each in made], 4 * [True, False])
        # Each rank has its own part, with a halo.
        mib = 4 * n**3 / 2**20
        self.assertAlmostEqual(made[0]["samples_mib"], mib)
        self.assertLess(made[4]["samples_mib"], 0.4 * mib)
        self.refused(2, "bench", "render", "--synthetic", "sphere", "--pyramid")
        # Ranks without a cell.
        with open(self.path("slab.raw"), "wb") as file:
            file.write(struct.pack("<18f", *(k - 0.5 for k in (0, 1, 2)), *(15 * [1.0])))
        thin = [self.footwall("bench", "render", "--raw", "slab.raw", "--dims", "3,3,2", "--value", 0, "--size", "64x64",
                              "--repeat", 1, "--ranks", ranks, "--pyramid") for ranks in (1, 5)]
        self.assertEqual(thin[0]["picture"], thin[1]["picture"])
        self.assertGreater(thin[0]["triangles"], 0)
        # What we write ourselves, text or binary, can be drawn.
        project = self.synthetic()
        for suffix in ("ply", "stl"):
            out = f"s.{suffix}"
            written = self.footwall("isosurface", project, "--value", "0.5", "--out", out)
            drawn = self.footwall("bench", "render", "--mesh", out, "--size", "64x64", "--ranks", 2, "--repeat", 1)
            self.assertEqual(drawn["triangles"], written["triangles"])
            self.assertGreater(drawn["pixels"], 200)
        with open(self.path("two.ply"), "w") as file:
            file.write("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                       "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                       "0 0 0\n1 0 0\n1 1 0\n0 1 1\n3 0 1 2\n3 0 2 3\n")
        made = self.footwall("bench", "render", "--mesh", "two.ply", "--size", "64x64", "--ranks", 3, "--repeat", 1)
        self.assertEqual(made["triangles"], 2)
        with open(self.path("broken.ply"), "w") as file:
            file.write("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n")
        self.refused(1, "bench", "render", "--mesh", "broken.ply")
        self.refused(1, "bench", "render", "--mesh", "ball.raw")
        self.refused(2, "bench", "render")
        self.refused(2, "bench", "render", "--raw", "ball.raw", "--value", 3)
        self.refused(2, "bench", "render", "--synthetic", "cube")
        for words in ("often", "nan", "inf"):
            self.refused(2, "bench", "render", "--synthetic", "sphere", "--group-threshold", words)
        self.refused(2, "bench", "render", "--synthetic", "sphere", "--repeat", 0)


if __name__ == "__main__":
    unittest.main()

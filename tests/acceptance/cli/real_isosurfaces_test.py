"""Isosurfaces of the real volumes: the serial algorithm of seed 000 and ours on 1 to 7 ranks write the same bytes."""
import hashlib
import pathlib
import unittest

from support import FootwallTest, test_data

DATA = test_data()
# File, how it is imported, isovalue.
VOLUMES = (("_derived/nucleon.nrrd", "nrrd", 120), ("_derived/hydrogen_orbital.nrrd", "nrrd", 0.1),
           ("_derived/headsq_quarter.nrrd", "nrrd", 800), ("_derived/HeadMRVolume.nrrd", "nrrd", 60),
           ("_derived/avg152T1.nrrd", "nrrd", 120),
           ("equinor+segyio/test-data/f3.sgy", "segy", 3000))


@unittest.skipIf(DATA is None, "skipped: no folder of real test files (FOOTWALL_TEST_DATA)")
class RealIsosurfaces(FootwallTest):
    def test_all_ranks_write_the_surface_of_plane(self):
        for file, kind, value in VOLUMES:
            with self.subTest(file):
                self.assertTrue((DATA / file).is_file(), file)
                name = pathlib.Path(file).stem + ".footwall"
                how = ("--domain", "depth", "--vertical-unit", "m") if kind == "nrrd" else \
                    ("--domain", "time", "--vertical-unit", "ms")
                self.footwall("new", name, f"--{kind}", DATA / file, *how)

                def made(*options):
                    answer = self.footwall("isosurface", name, "--value", value, "--out", "s.h5", *options)
                    return hashlib.sha256(pathlib.Path(self.path("s.h5")).read_bytes()).hexdigest(), answer

                expected, plane = made("--variant", "plane", "--ranks", 1, "--pillars", "1x1")
                self.assertGreater(plane["triangles"], 1000)
                self.assertEqual(plane["boundary_edges"]["inside"], 0)
                for ranks in (1, 2, 3, 4, 7):
                    found, answer = made("--ranks", ranks)
                    self.assertEqual(found, expected, f"{ranks} ranks")
                    for key in ("components", "genus", "euler", "area", "boundary_edges"):
                        self.assertEqual(answer[key], plane[key])


if __name__ == "__main__":
    unittest.main()

"""The real NRRD files through the programs, against what the manifest states about them."""
import array
import math
import pathlib
import re
import unittest

from support import FootwallTest, test_data

DATA = test_data()


def floats(path):
    values = array.array("f")
    values.frombytes(pathlib.Path(path).read_bytes())
    return values


@unittest.skipIf(DATA is None, "skipped: no folder of real test files (FOOTWALL_TEST_DATA)")
class RealVolumes(FootwallTest):
    def test_every_nrrd_has_the_facts_of_the_manifest(self):
        checked = 0
        for row in (DATA / "MANIFEST.tsv").read_text().splitlines()[1:]:
            fields = row.split("\t")
            found = re.match(r"(\d+)x(\d+)x(\d+) (\w+) min (\S+) max (\S+) distinct (\d+)", fields[7] if len(fields) > 7 else "")
            path = DATA / fields[0]
            if not found or path.suffix != ".nrrd" or not path.is_file():
                continue
            with self.subTest(fields[0]):
                dims, (kind, low, high, distinct) = [int(n) for n in found.groups()[:3]], found.groups()[3:]
                self.assertEqual(self.footwall("info", path)["type"], kind.replace("float32", "float"))
                name = path.stem + ".footwall"
                report = self.footwall("new", name, "--nrrd", path, "--domain", "depth", "--vertical-unit", "m")
                self.assertEqual((report["dims"], report["min"], report["max"]), (dims, float(low), float(high)))
                self.footwall("export", name, "--raw", "o.raw")
                values = floats(self.path("o.raw"))
                self.assertEqual(len(values), math.prod(dims))
                self.assertEqual(len(set(values)), int(distinct))
                checked += 1
        self.assertGreaterEqual(checked, 8)

    def test_a_detached_header_and_its_packed_twin_are_one_volume(self):
        pairs = ((DATA / "pyvista+vtk-data/Data/headsq/quarter.nhdr", DATA / "_derived/headsq_quarter.nrrd"),
                 (DATA / "bilgili+Voreen/resource/volumes/nucleon.nrrd", DATA / "_derived/nucleon.nrrd"))
        for detached, packed in pairs:
            answers = []
            for n, file in enumerate((detached, packed)):
                name = f"{packed.stem}{n}.footwall"
                self.footwall("new", name, "--nrrd", file, "--domain", "depth", "--vertical-unit", "m")
                self.footwall("export", name, "--raw", "o.raw")
                answers.append(floats(self.path("o.raw")))
            self.assertEqual(answers[0], answers[1])


if __name__ == "__main__":
    unittest.main()

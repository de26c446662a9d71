"""footwall bench topology: rows of a CSV file against the case tables."""
import pathlib
import unittest

from support import FootwallTest

HEADING = "id,v0,v1,v2,v3,v4,v5,v6,v7,chi\n"


class Topology(FootwallTest):
    def write(self, text):
        pathlib.Path(self.path("t.csv")).write_text(text)

    def bench(self, *arguments):
        return self.footwall("bench", "topology", "--csv", "t.csv", *arguments)

    def test_a_tunnel_that_only_the_trilinear_tables_find(self):
        self.write("# opposite corners\n" + HEADING + "a,9,-1,-1,-1,-1,-1,-1,9,0\nb,1,-9,-9,-9,-9,-9,-9,1,2\n")
        bench = self.bench()
        self.assertEqual((bench["rows"], bench["mismatches"], bench["open_edges"]), (2, [], 0))
        seed = self.bench("--tables", "seed000")
        self.assertEqual(seed["mismatches"], [{"id": "a", "expected": {"euler": 0}, "got": {"euler": 2}}])

    def test_a_wrong_expectation_is_a_mismatch(self):
        self.write(HEADING + "1,9,-1,-1,-1,-1,-1,-1,-1,4\n")
        self.assertEqual(self.bench()["mismatches"], [{"id": "1", "expected": {"euler": 4}, "got": {"euler": 1}}])
        # At another isovalue all corners are below.
        self.assertEqual(self.bench("--value", 10)["mismatches"][0]["got"], {"euler": 0})

    def test_closed_grids_are_checked_for_components_genus_and_borders(self):
        ball = [1 if n == 13 else -1 for n in range(27)]
        names = "id,b0,genus,v0..v26\n"
        self.write(names + "in,1,0," + ",".join(map(str, ball)) + "\n")
        self.assertEqual(self.bench()["mismatches"], [])
        ball[0] = 1
        self.write(names + "out,2,0," + ",".join(map(str, ball)) + "\n")
        self.assertEqual(self.bench()["mismatches"],
                         [{"id": "out", "expected": {"boundary_edges": 0}, "got": {"boundary_edges": 3}}])

    def test_random_cells_are_those_of_the_sampled_field(self):
        found = {name: self.footwall("bench", "topology", "--cells", 5120, "--tables", name)
                 for name in ("trilinear", "seed000", "seed002")}
        self.assertEqual(found["trilinear"]["cells"], 5120)
        self.assertEqual(found["trilinear"]["cell_mismatches"], 0)
        self.assertLess(found["trilinear"]["cells_undecided"], 500)
        self.assertGreater(found["seed000"]["cell_mismatches"], 0)
        self.assertGreater(found["seed002"]["cell_mismatches"], found["seed000"]["cell_mismatches"])
        self.assertIn("nothing to compare", self.refused(2, "bench", "topology")["message"])
        self.refused(2, "bench", "topology", "--cells", -1)

    def test_wrong_files_are_refused_with_their_line(self):
        for text, part in ((HEADING + "1,2,3\n", "line 2: 3 fields instead of 10"),
                           (HEADING + "1,9,-1,-1,x,-1,-1,-1,-1,4\n", "line 2: 'x' is no sample"),
                           (HEADING + "1,9,-1,-1,nan,-1,-1,-1,-1,4\n", "line 2: 'nan' is no sample"),
                           ("id,v0,v1,chi\n", "2 values are no cube"),
                           ("id,v1,v0\n", "not numbered"),
                           ("id,colour\n", "no column is called 'colour'"),
                           ("", "no heading")):
            self.write(text)
            error = self.refused(1, "bench", "topology", "--csv", "t.csv")
            self.assertEqual(error["code"], "format")
            self.assertIn(part, error["message"])
        self.refused(2, "bench", "topology", "--csv", "t.csv", "--tables", "lorensen")
        self.assertEqual(self.refused(1, "bench", "topology", "--csv", "none.csv")["code"], "not_found")


if __name__ == "__main__":
    unittest.main()

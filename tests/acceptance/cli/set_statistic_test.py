"""The user's own numbers of faces: kept, listed, exported and drawn; planes of volumes; replies of `edit`."""
import array
import csv
import json
import unittest

from support import FootwallTest


class SetStatistic(FootwallTest):
    def setUp(self):
        super().setUp()
        self.project = self.synthetic()
        self.footwall("triangulate", self.project)

    def faces(self, *options):
        self.footwall("faces", self.project, "--csv", "faces.csv", *options)
        with open(self.path("faces.csv"), encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_is_treated_like_any_other_statistic(self):
        rows = self.faces("--present")
        lines = ["fault,face,value"] + [f"{row['fault']},{row['face']},{n}" for n, row in enumerate(rows[1:])]
        done = self.footwall("set-statistic", self.project, "order", "--unit", "ms", "--values", "-",
                             stdin="\n".join(lines))
        self.assertEqual((done["faces"], done["undefined"]), (len(rows) - 1, 1))
        listed = self.faces()
        self.assertEqual([row["order"] for row in listed], [""] + [str(n) for n in range(len(rows) - 1)])
        ranked = self.footwall("faces", self.project, "--highest", "order", "--top", "1")
        self.assertEqual(ranked["faces"][0]["face"], rows[-1]["face"])
        self.footwall("export", self.project, "--vtp", "f.vtp", "--tsurf", "f.ts", "--properties", "order")
        self.assertIn(b'Name="order"', self.bytes("f.vtp"))
        self.assertIn(b"PROPERTIES order", self.bytes("f.ts"))
        self.footwall("render", self.project, "--faults", "--statistic", "order", "--size", "320x200", "--out", "a.png")
        self.footwall("render", self.project, "--faults", "--size", "320x200", "--out", "b.png")
        self.assertNotEqual(self.bytes("a.png"), self.bytes("b.png"))
        facts = self.footwall("info", self.project)
        self.assertIn({"name": "order", "unit": "ms", "colours": "viridis", "description": "set by hand"},
                      facts["statistics"])
        self.assertEqual((facts["runs"][0]["set_by_hand"], facts["runs"][0]["volume"]), ("order", None))
        self.assertIn("set by hand", self.start("info", self.project).stdout)
        # Not interpretation: undo does not know it, and a computed run is the default again.
        self.footwall("extract", self.project)
        self.assertIn("variance", self.faces()[0])
        self.assertNotIn("order", self.faces()[0])
        self.footwall("undo", self.project)
        self.assertEqual(len(self.footwall("info", self.project)["runs"]), 2)

    def bytes(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def test_refuses_what_it_cannot_place(self):
        error = self.refused(1, "set-statistic", self.project, "order", "--values", "-", stdin="face,value\n99.1,5\n")
        self.assertIn("99.1", error["message"])
        self.refused(1, "set-statistic", self.project, "variance", "--values", "-", stdin="face,value\n")
        self.refused(1, "set-statistic", self.project, "order", "--values", "none.csv")
        self.refused(2, "faces", self.project, "--present", "--lowest", "mean")

    def test_sections_are_planes_of_the_volume(self):
        self.footwall("export", self.project, "--raw", "whole")
        whole = array.array("f", self.bytes("whole"))
        first = self.footwall("info", self.project)["survey"]
        inline = first["inlines"]["first"] + 3 * first["inlines"]["step"]
        done = self.footwall("export", self.project, "--raw", "plane", "--section", f"inline={inline}")["section"]
        self.assertEqual(done, {"axis": 0, "index": 3, "dims": [36, 32]})
        self.assertEqual(array.array("f", self.bytes("plane")), whole[3 * 36 * 32:4 * 36 * 32])
        done = self.footwall("export", self.project, "--raw", "plane", "--section", "z=last")["section"]
        self.assertEqual(done, {"axis": 2, "index": 31, "dims": [40, 36]})
        self.assertEqual(array.array("f", self.bytes("plane")), whole[31::32])
        self.refused(1, "export", self.project, "--raw", "plane", "--section", "inline=1000000")
        self.refused(2, "export", self.project, "--section", "inline=first")

    def test_edit_answers_every_line_and_names_the_holder(self):
        lines = ['{"op":"add","what":"fault","name":"F"}',
                 '{"op":"add","what":"pillar","fault":"F","nodes":[[0,0,0],[0,0,50]]}']
        done = self.start("edit", self.project, stdin="\n".join([*lines, '{"op":"add","what":"node","pillar":987654,'
                                                                         '"position":[0,0,9]}']))
        self.assertEqual(done.returncode, 1)
        fault, pillar, error = map(json.loads, done.stdout.splitlines())
        self.assertEqual(len(pillar["nodes"]), 2)
        self.assertEqual(error["error"]["code"], "not_found")
        added = self.start("edit", self.project, stdin=f'{{"op":"add","what":"node","pillar":{pillar["pillar"]},'
                                                       '"at":1,"position":[0,0,25]}')
        node = json.loads(added.stdout)["node"]
        known = [each for each in self.footwall("faults", self.project)["faults"] if each["fault"] == fault["fault"]][0]
        self.assertEqual(known["pillars"][0]["pillar"], pillar["pillar"])
        self.assertEqual([each["node"] for each in known["pillars"][0]["nodes"]],
                         [pillar["nodes"][0], node, pillar["nodes"][1]])


if __name__ == "__main__":
    unittest.main()

"""What a careless or hostile user tries: nothing is lost, nothing is left behind, and the answer is kind."""
import array
import json
import math
import os
import pathlib
import signal
import socket
import struct
import subprocess
import unittest

from support import BIN, FootwallTest


class Care(FootwallTest):
    def running(self, *arguments):
        return subprocess.Popen([str(BIN / "footwall"), *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, cwd=self.folder)

    def test_no_output_replaces_a_project_or_a_volume(self):
        project = self.synthetic()
        other = self.synthetic("other.footwall")
        self.footwall("extract", project, "--ranks", 1)
        os.symlink(self.path(project), self.path("link.csv"))
        volume = f"{other}.volumes/amplitude.h5"
        for arguments in (("export", project, "--csv", project), ("export", project, "--vtp", other),
                          ("export", project, "--tsurf", "link.csv"), ("export", project, "--raw", volume),
                          ("faces", project, "--csv", project),
                          ("render", project, "--faults", "--size", "64x64", "--out", project)):
            self.assertIn("not written over", self.refused(1, *arguments)["message"])
        self.footwall("info", project, "--verify")
        self.footwall("info", other, "--verify")

    def test_ctrl_c_ends_edit_and_the_edits_before_it_stay(self):
        project = self.synthetic()
        editor = self.running("edit", project)
        editor.stdin.write('{"op":"add","what":"fault","name":"mine"}\n')
        editor.stdin.flush()
        editor.stdout.readline()
        editor.send_signal(signal.SIGINT)
        _, words = editor.communicate(timeout=60)
        self.assertEqual(editor.returncode, 130)
        self.assertIn("cancelled after 1 edits", words)
        self.assertIn("mine", [fault["name"] for fault in self.footwall("info", project)["faults"]])

    def test_a_cancelled_new_says_that_and_nothing_else(self):
        maker = self.running("new", "big.footwall", "--synthetic", "faulted", "--size", "512x512x512")
        for line in maker.stderr:  # it is under way
            if "write" in line:
                break
        maker.send_signal(signal.SIGINT)
        _, words = maker.communicate(timeout=60)
        self.assertEqual(maker.returncode, 130)
        self.assertEqual([line for line in words.splitlines() if line.startswith(("footwall", "error", "warning"))],
                         ["footwall: cancelled (nothing was changed)"])
        self.assertEqual(os.listdir(self.folder), [])

    def big_segy(self, inlines, crosslines, samples):
        """IEEE float32 zeros; the file system keeps no block for most of them."""
        path = self.path("big.sgy")
        with open(path, "wb") as file:
            binary = bytearray(400)
            struct.pack_into(">h", binary, 16, 4000)
            struct.pack_into(">h", binary, 20, samples)
            struct.pack_into(">h", binary, 24, 5)
            file.write(b"\x40" * 3200 + binary)
            for trace in range(inlines * crosslines):
                i, j = divmod(trace, crosslines)
                header = bytearray(240)
                struct.pack_into(">iiii", header, 180, 500000 + 25 * i, 6000000 + 25 * j, i + 1, j + 1)
                file.write(header)
                file.seek(4 * samples, os.SEEK_CUR)
            file.truncate()
        return path

    def test_a_cancelled_import_leaves_no_half_volume(self):
        segy = self.big_segy(144, 144, 8000)
        self.footwall("new", "p.footwall")
        before = sorted(os.listdir(self.folder))
        for step in ("read headers", "write"):
            with self.subTest(step):
                importer = self.running("import", "volume", "p.footwall", segy, "--domain", "time",
                                        "--vertical-unit", "ms")
                for line in importer.stderr:  # it is under way
                    if step in line:
                        break
                importer.send_signal(signal.SIGINT)
                _, words = importer.communicate(timeout=60)
                self.assertEqual(importer.returncode, 130, words)
                self.assertIn("footwall: cancelled", words)
                self.assertEqual(sorted(os.listdir(self.folder)), before)
                self.assertEqual(self.footwall("info", "p.footwall")["volumes"], [])

    def test_a_mesh_too_fine_to_hold_is_refused_at_once(self):
        project = self.synthetic(size="64x56x48")
        error = self.refused(1, "triangulate", project, "--max-edge", 0.01)
        self.assertEqual(error["code"], "memory")
        self.assertIn("million vertices", error["message"])

    def test_a_crossing_is_reported_once(self):
        self.footwall("new", "c.footwall", "--synthetic", "faulted", "--size", "40x36x32")
        survey = self.footwall("info", "c.footwall")["survey"]

        def node(i, j, k):
            return {"inline": survey["inlines"]["first"] + i * survey["inlines"]["step"],
                    "crossline": survey["crosslines"]["first"] + j * survey["crosslines"]["step"],
                    "z": survey["z0"] + k * survey["interval"]}
        pillars = [[node(i, 10, 0), node(i, 10, 24)] for i in (4, 20)] + [[node(0, 11, 12), node(30, 11, 12)]]
        lines = [{"op": "add", "what": "fault", "name": "crossed"}]
        lines += [{"op": "add", "what": "pillar", "fault": "crossed", "nodes": nodes} for nodes in pillars]
        self.assertEqual(self.start("edit", "c.footwall", stdin="\n".join(map(json.dumps, lines))).returncode, 0)
        (fault,) = self.footwall("triangulate", "c.footwall", "--fault", "crossed")["faults"]
        self.assertEqual(len([note for note in fault["notes"] if "tied half-way" in note]), 2, fault["notes"])

    def test_slips_of_the_pen_are_wrong_usage(self):
        project = self.synthetic()
        raw = ("new", "r.footwall", "--raw", "r.raw", "--dims", "1x1x1")
        for word, arguments in (("--velocity", ("extract", project, "--velocity", -5)),
                                ("--velocity", ("extract", project, "--velocity", "nan")),
                                ("0 ranks", ("extract", project, "--ranks", 0)),
                                ("100000 ranks", ("extract", project, "--ranks", 100000)),
                                ("--interval", (*raw, "--domain", "time", "--vertical-unit", "ms", "--interval", -4)),
                                ("time", (*raw, "--domain", "time", "--vertical-unit", "m", "--interval", 4)),
                                ("--top", ("faces", project, "--top", -1)),
                                ("--seed", ("new", "n.footwall", "--synthetic", "faulted", "--seed", -1)),
                                ("'frob'", ("frob",)), ("'import frob'", ("import", "frob"))):
            self.assertIn(word, self.refused(2, *arguments)["message"])

    def test_impossible_paths_are_no_bug_of_the_program(self):
        project = self.synthetic()
        for arguments in (("info", ""), ("new", ""), ("new", "n" * 300 + ".footwall"),
                          ("import", "sticks", project, "."), ("import", "sticks", project, "")):
            error = self.refused(1, *arguments)
            self.assertIn(error["code"], ("io", "not_found"), error)
        self.assertIn("directory", self.refused(1, "import", "sticks", project, ".")["message"].lower())

    def test_a_volume_without_a_value_has_no_range(self):
        pathlib.Path(self.path("n.raw")).write_bytes(array.array("f", [math.nan] * 8).tobytes())
        made = self.footwall("new", "n.footwall", "--raw", "n.raw", "--dims", "2x2x2", "--domain", "time",
                             "--vertical-unit", "ms", "--interval", 4)
        self.assertEqual((made["min"], made["max"], made["null_count"]), (None, None, 8))

    def test_another_volume_in_a_volumes_place_is_not_taken_for_it(self):
        project = self.synthetic()
        self.footwall("new", "other.footwall", "--synthetic", "faulted", "--size", "40x36x32", "--seed", 9)
        volume = pathlib.Path(self.path(f"{project}.volumes/amplitude.h5"))
        volume.write_bytes(pathlib.Path(self.path("other.footwall.volumes/amplitude.h5")).read_bytes())
        # Of equal size or not: what is read is the project's volume, or an error.
        for arguments in (("export", project, "--raw", "o.raw"),
                          ("render", project, "--section", "inline=first", "--size", "64x64", "--out", "p.png")):
            self.assertIn("checksum", self.refused(1, *arguments)["message"])
        done = self.start("info", project, "--verify", "--json")
        self.assertFalse(done.returncode == 0 and json.loads(done.stdout)["verified"], done.stdout)

    def test_what_a_killed_extract_left_is_swept_by_the_next(self):
        project = self.synthetic()
        gone = subprocess.Popen(["true"])
        gone.wait()
        left = self.folder / "tmp" / f"footwall-{os.geteuid()}-{socket.gethostname()}-{gone.pid}-abcdef"
        left.mkdir(parents=True)
        (left / "JOB.json").write_text("{}")
        done = self.start("extract", project, "--ranks", 1, env={"TMPDIR": self.path("tmp")})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(os.listdir(self.folder / "tmp"), [])
        done = self.start("extract", project, env={"TMPDIR": self.path("nowhere")})
        self.assertEqual(done.returncode, 1)
        self.assertIn("TMPDIR", done.stderr)


if __name__ == "__main__":
    unittest.main()

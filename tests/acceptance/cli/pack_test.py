"""footwall pack: a project travels as one file, and no archive, however made, does harm."""
import io
import os
import pathlib
import signal
import subprocess
import tarfile
import unittest

from support import BIN, FootwallTest


class Pack(FootwallTest):
    def listing(self):
        return sorted(os.listdir(self.folder))

    def unpacked(self, archive="a.tar", into="there"):
        os.makedirs(self.path(into), exist_ok=True)
        return self.footwall("pack", "--unpack", archive, "--into", into)

    def test_a_project_moves_as_one_file(self):
        project = self.synthetic()
        self.footwall("triangulate", project)
        checksum = self.footwall("extract", project, "--ranks", 1)["checksum"]
        packed = self.footwall("pack", project, "a.tar")
        self.assertEqual(packed["volumes"], ["amplitude"])
        self.assertEqual(packed["bytes"], os.path.getsize(self.path("a.tar")))
        with tarfile.open(self.path("a.tar")) as tar:
            self.assertEqual(tar.getnames(), [project, f"{project}.volumes/amplitude.h5", f"{project}.pack.json"])
        there = self.unpacked()["project"]
        before, after = self.footwall("info", project), self.footwall("info", there, "--verify")
        for key in ("survey", "volumes", "faults", "truth", "runs"):
            self.assertEqual(before[key], after[key])
        self.assertEqual(self.footwall("extract", there, "--ranks", 2)["checksum"], checksum)
        self.assertIn("already exists", self.refused(1, "pack", "--unpack", "a.tar", "--into", "there")["message"])
        self.assertIn("already exists", self.refused(1, "pack", project, "a.tar")["message"])

    def test_any_tar_unpacks_it(self):
        project = self.synthetic("störung.footwall")
        self.footwall("pack", project, "a.tar")
        os.mkdir(self.path("by-tar"))
        subprocess.run(["tar", "xf", "../a.tar"], cwd=self.path("by-tar"), check=True)
        self.assertTrue(self.footwall("info", f"by-tar/{project}", "--verify")["verified"])

    def test_it_is_packed_while_somebody_edits(self):
        project = self.synthetic()
        editor = subprocess.Popen([str(BIN / "footwall"), "edit", project], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                  text=True, cwd=self.folder)
        editor.stdin.write('{"op":"add","what":"fault","name":"mine"}\n')
        editor.stdin.flush()
        editor.stdout.readline()
        self.footwall("pack", project, "a.tar")
        editor.communicate(timeout=60)
        self.assertIn("mine", [fault["name"] for fault in self.footwall("info", self.unpacked()["project"])["faults"]])

    def test_missing_volumes_are_said(self):
        project = self.synthetic()
        os.rename(self.path(f"{project}.volumes/amplitude.h5"), self.path("moved.h5"))
        before = self.listing()
        error = self.refused(1, "pack", project, "a.tar")
        self.assertIn("amplitude", error["message"])
        self.assertIn("--without-missing", error["hint"])
        self.assertEqual(self.listing(), before)
        self.assertEqual(self.footwall("pack", project, "a.tar", "--without-missing")["missing"], ["amplitude"])
        there = self.unpacked()
        self.assertEqual(there["missing"], ["amplitude"])
        self.footwall("relink", there["project"], "moved.h5")
        self.assertEqual(self.footwall("info", there["project"], "--verify")["missing"], [])

    def test_ctrl_c_leaves_nothing(self):
        project = self.synthetic(size="256x256x256")
        before = self.listing()
        for arguments, word in ((("pack", project, "a.tar"), "pack"), (("pack", "--unpack", "b.tar"), "unpack")):
            if word == "unpack":
                self.footwall("pack", project, "b.tar")
                os.rename(self.path(project), self.path("kept"))
                os.rename(self.path(f"{project}.volumes"), self.path("kept.volumes"))
                before = self.listing()
            running = subprocess.Popen([str(BIN / "footwall"), *arguments], stderr=subprocess.PIPE, text=True, cwd=self.folder)
            for line in running.stderr:
                if f"  {word}  " in line:
                    break
            running.send_signal(signal.SIGINT)
            running.communicate(timeout=60)
            self.assertEqual(running.returncode, 130)
            self.assertEqual(self.listing(), before)

    def test_hostile_archives_write_nothing(self):
        os.mkdir(self.path("there"))

        def member(name, content=b"x", kind=tarfile.REGTYPE, link=""):
            info = tarfile.TarInfo(name)
            info.type, info.linkname = kind, link
            info.size = len(content) if kind == tarfile.REGTYPE else 0
            return info, content
        outside = pathlib.Path(self.path("outside"))
        cases = {
            "leaves the folder": [member("../outside")],
            "absolute": [member(str(outside))],
            "a link out": [member("p.footwall", kind=tarfile.SYMTYPE, link=str(outside)), member("p.footwall")],
            "a hard link": [member("p.footwall", kind=tarfile.LNKTYPE, link="/etc/passwd")],
            "a device": [member("p.footwall", kind=tarfile.CHRTYPE)],
            "twice": [member("p.footwall"), member("p.footwall")],
            "no project": [member("p.footwall", b"text" * 1000), member("p.footwall.pack.json", b"{}")],
            "something else": [member("p.footwall"), member("q.h5")],
            "empty": [],
        }
        for name, members in cases.items():
            with self.subTest(name):
                with tarfile.open(self.path("h.tar"), "w", format=tarfile.PAX_FORMAT) as tar:
                    for info, content in members:
                        tar.addfile(info, io.BytesIO(content) if info.size else None)
                error = self.refused(1, "pack", "--unpack", "h.tar", "--into", "there")
                self.assertIn(error["code"], ("format", "corrupt"), error)
                self.assertEqual(os.listdir(self.path("there")), [])
                self.assertFalse(outside.exists())

    def test_cut_and_altered_archives_are_refused(self):
        project = self.synthetic()
        self.footwall("pack", project, "whole.tar")
        whole = pathlib.Path(self.path("whole.tar")).read_bytes()
        os.mkdir(self.path("there"))
        altered = bytearray(whole)
        altered[len(whole) * 2 // 3] ^= 4
        for content in (whole[:len(whole) // 2], whole[:-2048], whole[:700], bytes(altered)):
            pathlib.Path(self.path("a.tar")).write_bytes(content)
            self.assertIn(self.refused(1, "pack", "--unpack", "a.tar", "--into", "there")["code"], ("format", "corrupt"))
            self.assertEqual(os.listdir(self.path("there")), [])

    def test_slips_of_the_pen(self):
        project = self.synthetic()
        self.assertIn("archive", self.refused(2, "pack", project)["message"])
        self.refused(2, "pack", project, "a.tar", "--into", ".")
        self.refused(2, "pack", "--unpack", "a.tar", "b.tar")
        self.assertEqual(self.refused(1, "pack", "--unpack", "none.tar")["code"], "not_found")
        self.assertEqual(self.refused(1, "pack", "--unpack", project)["code"], "format")


if __name__ == "__main__":
    unittest.main()

"""The program footwall-studio as a user starts it."""
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

BIN = pathlib.Path(os.environ["FOOTWALL_BIN"])
SOURCE = pathlib.Path(os.environ["FOOTWALL_SOURCE"])
ON_A_SCREEN = [sys.executable, "-B", str(SOURCE / "tests" / "ui" / "on_a_screen.py")]


class StudioTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="footwall-studio-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def studio(self, *arguments, screen=True, **environment):
        before = ON_A_SCREEN if screen else []
        return subprocess.run([*before, str(BIN / "footwall-studio"), *map(str, arguments)], capture_output=True,
                              text=True, timeout=250, cwd=self.folder, env={**os.environ, **environment})

    def test_version_and_usage(self):
        version = self.studio("--version", screen=False)
        self.assertEqual(version.returncode, 0)
        self.assertRegex(version.stdout, r"^footwall-studio \d+\.\d+\.\d+\n$")
        wrong = self.studio("--theme", "pink", screen=False)
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("pink", wrong.stderr)

    def test_no_display_is_said_and_exits_1(self):
        without = {name: value for name, value in os.environ.items()
                   if name not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
        done = subprocess.run([str(BIN / "footwall-studio")], capture_output=True, text=True, env=without, timeout=60)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("no display", done.stderr)
        lost = self.studio(screen=False, DISPLAY=":9471", QT_QPA_PLATFORM="xcb")
        self.assertEqual(lost.returncode, 1, lost.stderr)
        self.assertTrue(lost.stderr)

    @unittest.skipIf(shutil.which("Xvfb") is None, "no Xvfb")
    def test_a_missing_project_exits_1(self):
        done = self.studio("none.footwall")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("none.footwall", done.stderr)
        (self.folder / "letter.footwall").write_text("Dear all,")
        refused = self.studio("letter.footwall", "--screenshot", "no.png")
        self.assertEqual(refused.returncode, 1, refused.stderr)
        self.assertIn("letter.footwall", refused.stderr)
        self.assertFalse((self.folder / "no.png").exists())

    @unittest.skipIf(shutil.which("Xvfb") is None, "no Xvfb")
    def test_a_picture_of_a_project_and_of_the_start_page(self):
        subprocess.run([str(BIN / "footwall"), "new", "s.footwall", "--synthetic", "faulted", "--size", "40x36x32",
                        "--quiet"], check=True, cwd=self.folder, capture_output=True)
        for arguments, name in ((["s.footwall"], "project.png"), (["--theme", "light"], "start.png")):
            done = self.studio(*arguments, "--screenshot", name)
            self.assertEqual(done.returncode, 0, done.stderr)
            data = (self.folder / name).read_bytes()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            width, height = struct.unpack(">II", data[16:24])
            self.assertEqual((width, height), (1600, 1000))
        whole = subprocess.run([str(BIN / "footwall"), "info", "s.footwall", "--verify", "--json"], cwd=self.folder,
                               capture_output=True, text=True)
        self.assertEqual(whole.returncode, 0, whole.stderr)

    def test_the_desktop_entry_and_mime_type_agree(self):
        entry = (SOURCE / "packaging" / "footwall-studio.desktop").read_text()
        mime = (SOURCE / "packaging" / "footwall.xml").read_text()
        self.assertIn("Exec=footwall-studio %f", entry)
        self.assertIn("MimeType=application/vnd.footwall.project;", entry)
        self.assertIn('type="application/vnd.footwall.project"', mime)


if __name__ == "__main__":
    unittest.main()

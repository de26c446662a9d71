"""SEG-Y through the programs: the report before an import, header options, and what is refused why."""
import pathlib
import struct
import unittest

from support import FootwallTest

CONTRACT = ("format", "endian", "revision", "traces", "samples", "interval_us", "inlines", "crosslines",
            "live_traces", "duplicates", "warnings")


def segy(words, samples=4, code=5, interval=4000, values=None):
    """A big-endian file of revision 0; words: for each trace {byte: int, or packed bytes}."""
    text = b"".join(f"C{n + 1:2d} made for a test".ljust(80).encode() for n in range(40))
    binary = bytearray(400)
    for byte, value in ((3217, interval), (3221, samples), (3225, code), (3255, 1)):
        struct.pack_into(">h", binary, byte - 3201, value)
    body = b""
    for number, trace in enumerate(words):
        header = bytearray(240)
        for byte, value in trace.items():
            packed = value if isinstance(value, bytes) else struct.pack(">i", value)
            header[byte - 1:byte - 1 + len(packed)] = packed
        body += bytes(header)
        body += values(number) if values else struct.pack(f">{samples}f", *[number + n / 8 for n in range(samples)])
    return text + bytes(binary) + body


def grid(at, inlines=6, crosslines=7):
    """at: bytes of inline, crossline, X and Y."""
    return [dict(zip(at, (10 + i, 200 + 2 * j, 400000 + 30 * i, 6000000 + 20 * j)))
            for i in range(inlines) for j in range(crosslines)]


class Segy(FootwallTest):
    def write(self, name, content):
        pathlib.Path(self.path(name)).write_bytes(content)
        return name

    def imported(self, file, *options):
        return self.footwall("new", file + ".footwall", "--segy", file, "--domain", "time", "--vertical-unit", "ms", *options)

    def test_the_report_has_the_keys_of_the_contract(self):
        facts = self.footwall("info", self.write("a.sgy", segy(grid((189, 193, 181, 185)))))
        for key in CONTRACT:
            self.assertIn(key, facts)
        self.assertEqual(facts["inlines"], {"first": 10, "last": 15, "step": 1, "count": 6})
        self.assertEqual(facts["crosslines"], {"first": 200, "last": 212, "step": 2, "count": 7})
        self.assertEqual((facts["importable"], facts["domain"], facts["residual_m"]), (True, None, 0))
        self.assertEqual(facts["candidates"][0]["preset"], "rev1")
        text = self.start("info", "a.sgy").stdout
        for words in ("10 to 15 by 1 (6)", "none: every bin has a live trace", "C 1 made for a test"):
            self.assertIn(words, text)

    def test_a_file_that_import_refuses_is_reported_all_the_same(self):
        traces = grid((189, 193, 181, 185))
        gathers = [{**trace, 37: offset} for trace in traces for offset in (100, 200)]
        cases = {"prestack": segy(gathers), "format 4": segy(traces, code=4), "no trace": segy([])}
        for reason, content in cases.items():
            with self.subTest(reason):
                facts = self.footwall("info", self.write("r.sgy", content))
                for key in CONTRACT:
                    self.assertIn(key, facts)
                self.assertFalse(facts["importable"])
                self.assertIn(reason, facts["reason"])
                error = self.refused(1, "new", "r.footwall", "--segy", "r.sgy", "--domain", "time", "--vertical-unit", "ms")
                self.assertIn(reason, error["message"])
                self.assertIn("cannot be imported", self.start("info", "r.sgy").stdout)

    def test_lines_elsewhere_by_preset_by_bytes_and_unasked(self):
        file = self.write("p.sgy", segy(grid((5, 21, 73, 77))))
        volume = self.imported(file)
        self.assertIn("the usual words make no grid", volume["assumed"][0])
        named = self.footwall("new", "n.footwall", "--segy", file, "--domain", "time", "--vertical-unit", "ms",
                              "--preset", "petrel_3d")
        self.assertEqual((named["assumed"], named["checksum"]), ([], volume["checksum"]))
        given = self.footwall("new", "g.footwall", "--segy", file, "--domain", "time", "--vertical-unit", "ms",
                              "--inline-byte", 5, "--crossline-byte", "23:int16", "--x-byte", 73, "--y-byte", 77)
        self.assertEqual(given["checksum"], volume["checksum"])
        for option, value in (("--preset", "rev9"), ("--x-byte", "81:float"), ("--inline-byte", 0)):
            self.refused(2, "info", file, option, value)

    def test_samples_beyond_float32_are_counted_in_a_warning(self):
        huge = struct.pack(">4d", 1e300, 0, 1, -1e300)
        file = self.write("d.sgy", segy(grid((189, 193, 181, 185)), code=6, values=lambda number: huge))
        done = self.start("new", "d.footwall", "--segy", file, "--domain", "time", "--vertical-unit", "ms")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("84 samples are beyond what a float32 holds", done.stderr)
        again = self.footwall("import", "volume", "d.footwall", file, "--domain", "time", "--vertical-unit", "ms",
                              "--name", "again")
        self.assertIn("84 samples are beyond what a float32 holds", again["warnings"][-1])

    def test_options_that_contradict_the_survey_are_refused(self):
        file = self.write("c.sgy", segy(grid((189, 193, 181, 185))))
        self.imported(file, "--crs", "EPSG:23031")
        more = ("import", "volume", "c.sgy.footwall", file, "--name", "again", "--domain", "time", "--vertical-unit", "ms")
        error = self.refused(1, *more, "--crs", "EPSG:32631")
        self.assertIn("EPSG:23031", error["message"])
        self.footwall(*more, "--crs", "EPSG:23031")

    def test_files_too_damaged_to_be_recognised_are_reported_by_their_name(self):
        traces = grid((189, 193, 181, 185))
        for content in (b"", b"x" * 100, bytes(100000), segy(traces, code=99)):
            facts = self.footwall("info", self.write("BAD.SGY", content))
            for key in CONTRACT:
                self.assertIn(key, facts)
            self.assertFalse(facts["importable"])
            self.assertTrue(facts["reason"] and facts["hint"])

    def test_wild_coordinates_of_one_trace_do_not_move_the_map(self):
        traces = grid((189, 193, 181, 185))
        good = self.footwall("info", self.imported(self.write("w.sgy", segy(traces))) and "w.sgy.footwall")["survey"]["map"]
        for n, (x, y) in enumerate(((2000000000, 5), (400000, 60000000), (400500, 6000000))):
            wild = [dict(trace) for trace in traces]
            wild[17 + n].update({181: x, 185: y})
            report = self.imported(self.write(f"w{n}.sgy", segy(wild)))
            self.assertIn("coordinates of 1 traces lie far off", report["warnings"][0])
            bad = self.footwall("info", f"w{n}.sgy.footwall")["survey"]["map"]
            for key in good:
                for a, b in zip(good[key], bad[key]):
                    self.assertAlmostEqual(a, b, places=1)
            self.assertEqual(report["live_traces"], 42)

    def test_an_interval_must_be_given_where_headers_have_none(self):
        file = self.write("i.sgy", segy(grid((189, 193, 181, 185)), interval=-2))
        error = self.refused(1, "new", "i.footwall", "--segy", file, "--domain", "time", "--vertical-unit", "ms")
        self.assertIn("--interval", error["hint"])
        self.imported(file, "--interval", 2)
        self.assertEqual(self.footwall("info", "i.sgy.footwall")["survey"]["interval"], 2)


if __name__ == "__main__":
    unittest.main()

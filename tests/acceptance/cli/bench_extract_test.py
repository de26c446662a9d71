"""footwall bench extract: the seed's benchmarks, small."""
import json
import unittest

from support import FootwallTest


class BenchExtract(FootwallTest):
    SMALL = ("bench", "extract", "--benchmarks", 1, "--ranks", "1,2", "--exchange", "minimum,reduce", "--balance",
             "none,manhattan=0,2", "--scale", 0.01)

    def test_all_pairs_and_auto_run_and_agree(self):
        done = self.footwall(*self.SMALL, "--file", "figures.json")
        cells = {(c["ranks"], c["exchange"], c["balance"]) for c in done["cells"]}
        self.assertEqual(cells, {(1, "minimum", "none"), (1, "reduce", "none"), (1, "auto", "auto"),
                                 (2, "minimum", "none"), (2, "minimum", "manhattan=0,2"), (2, "reduce", "none"),
                                 (2, "reduce", "manhattan=0,2"), (2, "auto", "auto")})
        self.assertEqual(len({c["checksum"] for c in done["cells"]}), 1)
        for cell in done["cells"]:
            self.assertGreater(cell["slowest_rank"], 0)
            self.assertGreater(cell["speedup"], 0)
        self.assertEqual([one["ranks"] for one in done["auto_against_seed"]], [2])
        self.assertEqual([rates["ranks"] for rates in done["rates"]], [2])
        self.assertEqual(json.loads((self.folder / "figures.json").read_text()), done)

    def test_tables_have_the_seeds_figures(self):
        text = self.start(*self.SMALL, "--markdown").stdout
        self.assertIn("| minimum, none | MC-nolb |", text)
        self.assertIn("[43.83]", text)  # F.1, 2 CPUs
        self.assertIn("[36.39]", text)  # the serial run

    def test_what_cannot_be_is_refused(self):
        for wrong in (("--benchmarks", 4), ("--ranks", "0"), ("--scale", 2), ("--exchange", "pigeon"), ("--repeat", 0)):
            self.refused(2, "bench", "extract", *wrong)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
"""Every way in which a board's lines can be wrong is a failure that names the line: tests of check_manifest.py."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).with_name("check_manifest.py")
MANIFEST = """# a comment
01-a                     64   48 bdf94156 what it proves
run-1                   240  160 f296a526 a run
run-1                  not on m7: takes 384 KiB
run-1/mesh-00             2    0 02e1198d one line
"""
FULL = ["# golden: 2 cases on host", "01-a 64 48 bdf94156", "run-1 240 160 f296a526", "run-1/mesh-00 2 0 02e1198d",
        "# golden: done, 3 lines"]
SMALL = ["# golden: 2 cases on m7", "01-a 64 48 bdf94156", "run-1 not on m7: takes 384 KiB", "# golden: done, 2 lines"]


class CheckManifest(unittest.TestCase):
    def check(self, lines, board="host", manifest=MANIFEST):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "manifest")
            path.write_text(manifest)
            run = subprocess.run([sys.executable, CHECK, path, "-", "--board", board], input="\n".join(lines) + "\n",
                                 capture_output=True, text=True, timeout=60)
        return run.returncode, run.stdout + run.stderr

    def expect_fault(self, lines, said, board="host"):
        code, text = self.check(lines, board)
        self.assertEqual(code, 1, text)
        self.assertIn(said, text)

    def test_all_lines_the_same_is_right(self):
        self.assertEqual(self.check(FULL), (0, "host: 3 of 3 lines as in the manifest\n"))

    def test_console_around_the_players_lines_and_carriage_returns_do_not_matter(self):
        self.assertEqual(self.check(["boot 1.0\r", *(line + "\r" for line in FULL), "2000 instructions"])[0], 0)

    def test_case_passed_over_with_the_manifests_reason_is_right(self):
        self.assertEqual(self.check(SMALL, "m7"),
                         (0, "m7: 1 of 1 lines as in the manifest, 1 cases are not on this board\n"))

    def test_different_crc_is_named(self):
        self.expect_fault([line.replace("bdf94156", "bdf94157") for line in FULL],
                          "01-a: expected 64 48 bdf94156, got 64 48 bdf94157")

    def test_different_size_is_named(self):
        self.expect_fault([line.replace(" 2 0 ", " 3 0 ") for line in FULL], "run-1/mesh-00: expected 2 0 02e1198d")

    def test_missing_line_is_named(self):
        self.expect_fault([*FULL[:3], "# golden: done, 2 lines"], "run-1/mesh-00: missing")

    def test_line_too_many_is_named(self):
        self.expect_fault([*FULL[:4], "run-1/mesh-01 2 0 02e1198d", "# golden: done, 4 lines"],
                          "run-1/mesh-01: too many")

    def test_line_printed_twice_is_named(self):
        self.expect_fault([*FULL[:4], FULL[1], "# golden: done, 4 lines"], "01-a: printed twice")

    def test_case_passed_over_without_a_reason_in_the_manifest_is_named(self):
        self.expect_fault([FULL[0], "01-a not on host: too wide", *FULL[2:]], "01-a: passed over on host")

    def test_case_passed_over_for_another_reason_is_named(self):
        self.expect_fault([line.replace("384", "385") for line in SMALL], 'has "takes 384 KiB"', "m7")

    def test_case_left_out_without_a_line_is_named(self):
        self.expect_fault([*SMALL[:2], "# golden: done, 1 lines"], "run-1: missing", "m7")

    def test_case_played_that_the_manifest_takes_off_the_board_is_named(self):
        self.expect_fault([SMALL[0], *FULL[1:]], "run-1: too many; the manifest says it is not on this board", "m7")

    def test_failed_case_is_named(self):
        self.expect_fault([*FULL[:1], "01-a failed: engine: stopped 7", *FULL[2:]], "01-a failed: engine: stopped 7")

    def test_output_that_ends_early_fails(self):
        self.expect_fault(FULL[:4], "did not come to its end")

    def test_line_lost_on_the_way_fails(self):
        self.expect_fault([*FULL[:3], FULL[4]], "2 lines, but the player printed 3")

    def test_output_of_another_board_fails(self):
        self.expect_fault(FULL, "played for host, not for m7", "m7")

    def test_output_without_the_player_fails_with_what_it_said(self):
        self.expect_fault(["# golden: bundle: cut short 12"], "bundle: cut short 12")

    def test_garbled_line_fails(self):
        self.expect_fault([*FULL[:1], "01-a 64 48 bdf9", *FULL[2:]], "no line of the player: 01-a 64 48 bdf9")

    def test_manifest_that_cannot_be_read_is_bad_input(self):
        self.assertEqual(self.check(FULL, manifest="01-a 64\n")[0], 3)
        self.assertEqual(self.check(FULL, manifest="")[0], 3)


if __name__ == "__main__":
    unittest.main()

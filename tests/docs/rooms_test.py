"""Puts a forbidden word into each room of a made-up project, to see that rooms.py finds it there and nowhere else."""
import itertools
import pathlib
import tempfile
import unittest

import rooms

# A line for each row of rooms.FORBIDDEN, in its order, that breaks that row.
BREACHES = [
    'X(kPrmSync, "Sync_Req, B024.2 is 0")',
    "// The DPRAM of the DSDPV1.",
    "int size = regs::kCfgDataSize;",
    "// Until INTR0 falls.",
    "void set(bool R_REQ);",
    "Interrupt& interrupt_;",
    "station_.slave().mail();",
    "assign a = b; // B024.2",
    '`include "dsdpv1_types.svh"',
    "input logic csr_i,",
]
A_CHIP = ["dsdpv1::Chip chip;", "void pin(mailbox::Pin pin);", "case Pin::kCsr:", '#include "model/dpram/ram.hpp"', "regs::Address at;",
          "AccessTiming access;", "dsdpv1::Level level;"]
ITS_CELLS = ["// As INTR0 falls.", "// B006 counts.", "if (R_REQ) return;"]
for breaches in (A_CHIP, ITS_CELLS):  # each in one general room, then again from the first
    BREACHES += itertools.islice(itertools.cycle(breaches), len(rooms.GENERAL_ROOMS))


class Rooms(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for room, _, _ in rooms.FORBIDDEN:
            self.write(room, "// Right.")

    def write(self, room, text):
        (self.root / room).mkdir(parents=True, exist_ok=True)
        (self.root / room / "block.hpp").write_text(text + "\n", encoding="utf-8")

    def test_a_right_project_has_no_fault(self):
        self.assertEqual(list(rooms.faults(self.root, rooms.FORBIDDEN)), [])

    def test_every_row_finds_its_breach_with_file_and_line(self):
        self.assertEqual(len(BREACHES), len(rooms.FORBIDDEN))
        for row, breach in zip(rooms.FORBIDDEN, BREACHES):
            with self.subTest(breach):
                self.write(row[0], "// Right.\n" + breach)
                found = list(rooms.faults(self.root, [row]))
                self.assertEqual(len(found), 1, found)
                self.assertTrue(found[0].startswith(f"{row[0]}/block.hpp:2: "), found[0])

    def test_whose_a_file_is_may_be_said_in_its_first_lines_only(self):
        # REUSE-IgnoreStart
        head = "// SPDX-FileCopyrightText: 2026 the dsdpv1 authors"
        # REUSE-IgnoreEnd
        pattern = [("model/profibus", r"dsdpv1", "no chip")]
        for text, count in ((head + "\n", 0), (head + "\nint dsdpv1;\n", 1), ("int a;  " + head + "\n", 1)):
            with tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder, "model", "profibus", "a.cpp")
                file.parent.mkdir(parents=True)
                file.write_text(text, encoding="utf-8")
                self.assertEqual(len(list(rooms.faults(pathlib.Path(folder), pattern))), count, text)

    def test_a_room_that_nobody_judges_or_clang_tidy_passes_over_is_a_fault(self):
        self.write("new/part", "// Right.")
        self.write("kinds/dsdpv1", "// Right.")
        (self.root / "docs").mkdir()
        for rooms_of_tidy, faults in (("kinds|new", 1), ("kinds", 2)):
            (self.root / ".clang-tidy").write_text(f"HeaderFilterRegex: '/({rooms_of_tidy})/'\n", encoding="utf-8")
            found = list(rooms.unknown_rooms(self.root))
            self.assertEqual([sum(fault.startswith(f"{room}: ") for fault in found) for room in ("new", "docs")], [faults, 0])

    def test_a_file_that_may_name_a_chip_for_now_is_a_fault_when_it_names_none(self):
        name = next(iter(rooms.named_for_now()))
        self.write(pathlib.Path(name).parent, "// Right.")
        for text, count in (("dsdpv1::Chip chip;", 0), ("// Right.", 1)):
            (self.root / name).write_text(text, encoding="utf-8")
            self.assertEqual(list(rooms.faults(self.root, rooms.FORBIDDEN)), [])
            self.assertEqual(sum(fault.startswith(name) for fault in rooms.names_no_chip_any_more(self.root)), count)

    def test_a_room_that_is_gone_is_a_fault(self):
        self.assertIn("no such room", next(rooms.faults(self.root, [("model/gone", "x", "nothing")])))


if __name__ == "__main__":
    unittest.main()

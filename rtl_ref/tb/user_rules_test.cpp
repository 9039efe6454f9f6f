// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// What the user chooses with B005 (D17) and B011 (D16).
#include "rtl_bench.hpp"

namespace rtl {
namespace {

constexpr int kHistory = 0x40, kClear = 0x80, kInputError = 0x04;

// The user writes cells in one hold and lets the chip in
struct Cell {
  int address, value;
};
void give(Bench& b, const std::vector<Cell>& cells) {
  b.own();
  for (const Cell& cell : cells) b.write(cell.address, cell.value);
  b.step(3);
  b.disown();
  b.step(200);
}

void give_inputs(Bench& b, bool right, int command_2) {
  const Bytes block = {4, 9, 8, 7, 6};
  const int crc = crc16(block) ^ (right ? 0 : 0x100);
  give(b, {{0x130, 4},
           {0x131, 9},
           {0x132, 8},
           {0x133, 7},
           {0x134, 6},
           {0x225, crc >> 8},
           {0x226, crc & 0xFF},
           {0x011, command_2},
           {0x010, 1}});
}

void expect_status(Bench& b, int errors, int command_2, const char* what) {
  expect(b.peek(0x00B, 1)[0], errors, what);
  expect(b.peek(0x011, 1)[0], command_2, "B011 behind it");
}

void initialise(Bench& b, int dpv1_enable, uint8_t limit = 4) {
  Bytes block = init_block(0, 1);
  block[7] = limit;
  std::vector<Cell> cells = {{0x005, dpv1_enable}};
  for (size_t i = 0; i < block.size(); ++i) cells.push_back({0x020 + static_cast<int>(i), block[i]});
  cells.insert(cells.end(), {{0x0F7, crc16(block) >> 8}, {0x0F8, crc16(block) & 0xFF}, {0x010, 4}});
  give(b, cells);
}

// While OFFLINE the user may ask for the clearing, too
void clearing_offline(Bench& b) {
  give(b, {{0x00B, 0xFF}, {0x011, kClear}});
  expect_status(b, 0xFF, 0, "B011.7 without B011.6");
  give(b, {{0x011, kClear | kHistory}});
  expect_status(b, 0xFB, kHistory, "B011.7 with B011.6");
  give(b, {{0x00B, 0}});
}

// Present and history of B00B.2
void history(Bench& b) {
  give_inputs(b, false, 0);
  expect_status(b, kInputError, 0, "present: a wrong CRC");
  give_inputs(b, true, 0);
  expect_status(b, 0, 0, "present: a right block clears");
  give_inputs(b, false, kHistory);
  expect_status(b, kInputError, kHistory, "history: a wrong CRC");
  give_inputs(b, true, kHistory);
  expect_status(b, kInputError, kHistory, "history: a right block clears nothing");
  give_inputs(b, true, kClear);
  expect_status(b, 0, 0, "present again: the right block clears");
  give_inputs(b, false, kHistory);
  give_inputs(b, true, kHistory | kClear);
  expect_status(b, 0, kHistory, "cleared ahead of a right block");
  give_inputs(b, false, kHistory | kClear);
  expect_status(b, kInputError, kHistory, "cleared ahead of a wrong block, which is shown");
  // With an answer on C1, whose commit writes B011 a second time: B00B.2 would be cleared once more
  give_inputs(b, false, kHistory | kClear | 1);
  expect_status(b, kInputError | 0x10, kHistory, "cleared once, and the CRC of the answer is wrong, too");
}

Bytes set_prm_dpv1() { return request(0x4D, 61, {0x88, 10, 10, 11, 0x0C, 0xC9, 1, 0x80, 0, 0}); }

// A slave has DPV1 when B005 says so at the initialisation, and keeps it until the next right one
void expect_dpv1(Bench& b, bool on, const char* what) {
  b.ask(set_prm_dpv1());
  const Bytes answer = b.ask(request(0x4D, 60, {}));
  expect(answer.size() > 9 ? answer[9] & 0x50 : -1, on ? 0 : 0x50, what);
  b.ask(request(0x4D, 61, {0x48, 0, 0, 0, 0x0C, 0xC9, 0}));
}

void dpv1_at_the_initialisation(Bench& b) {
  expect_dpv1(b, false, "DPV1_Enable, B005 = 0 at the initialisation");
  give(b, {{0x005, 0x1D}});
  expect_dpv1(b, false, "B005 = 1D written later");
  initialise(b, 0x1D, 255);
  expect_dpv1(b, false, "B005 = 1D at a refused initialisation");
  initialise(b, 0x1D);
  b.ask(sd1(9, 2, 0x49));
  expect_dpv1(b, true, "B005 = 1D at the initialisation");
  give(b, {{0x005, 0}});
  expect_dpv1(b, true, "B005 = 0 written later");
  initialise(b, 0, 255);
  expect_dpv1(b, true, "B005 = 0 at a refused initialisation");
}

}  // namespace

void user_rules(Bench& b) {
  b.release_reset();
  b.step(5000);
  clearing_offline(b);
  initialise(b, 0);
  b.ask(sd1(9, 2, 0x49));
  history(b);
  dpv1_at_the_initialisation(b);
}

}  // namespace rtl

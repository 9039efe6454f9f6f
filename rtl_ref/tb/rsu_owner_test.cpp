// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Ownership of the DPRAM with SPI (section 4, 5.3, 5.5; SP12 to SP17): claims, writes without one, read and write,
// U_Timer, block CRCs.
#include "rsu_bench.hpp"

namespace rtl {
namespace {

const Bytes kWritten = {0xA1, 0x00, 0x20, 0x78};
const Bytes kRefused = with_crc({0xE1, 0x00});

Chip with(Chip chip, unsigned fault) {
  chip.fault = fault;
  return chip;
}

// Puts the next frame so that it is judged at `judgement` when it has `bytes` bytes
void aim(RsuBench& b, int64_t judgement, size_t bytes) {
  const auto bits = static_cast<int64_t>(8 * bytes);
  b.tick = 250 * (judgement - 4) + 100 - b.lead - 2 * b.half * (bits - 1) - 1;
}

// The access that begins first at or after `from`, when neither side holds
int64_t next_access(const RsuBench& b, int64_t from) {
  int64_t s = b.own.rise;
  while (s < from) s += 48;
  return s;
}

// A claim judged at each cycle of an access and around it
void claims(RsuBench& b) {
  for (int64_t shift = -3; shift < 12; ++shift) {
    b.clock(300);
    const int64_t s = next_access(b, b.edge + 500);
    aim(b, s + shift, 7);
    const bool granted = shift <= 0 || shift > 7;
    expect_bytes(b.spi(write_telegram(0x014, {2}), 4), granted ? kWritten : kRefused, "claim at a cycle of an access");
    expect(b.judged, s + shift, "the claim is judged where it was aimed");
    expect(b.host.level, granted, "B014.1");
    if (!granted) continue;
    if (shift <= 0) expect(b.own.rise < s, 1, "the claim is first: no access begins");
    b.clock(500);
    expect(b.own.rise < b.judged + 1, 1, "no access while the host owns");
    b.spi(write_telegram(0x014, {0}), 4);
    expect(b.own.rise >= b.judged + 1, 1, "an access begins after the release");
    expect(b.host.fall, b.judged, "release");
  }
  b.clock(300);
  b.claim();
  b.clock(500);
  b.own.rise = -1;
  b.high = 0;
  b.spi(write_telegram(0x014, {0}), 0);
  b.clock(10);
  expect(b.own.rise, b.judged + 1, "an overdue access begins a cycle after the release's judgement");
  b.high = 600;
  b.clock(400);
}

void claims_among_others(RsuBench& b) {
  b.claim();
  b.write(0x013, {0x33, 0xFE, 0x55});  // keeps it; the other bits of B014 are ignored
  expect_bytes(b.read(0x012, 4), {0xF0, 0x33, 0x02, 0x55}, "B014 among other cells");
  expect(b.cell(0x014), 0, "the cell of B014");
  b.write(0x013, {0x34, 0xFD});
  expect(b.host.level, 0, "a release among other cells");
  b.clock(400);
  expect(b.cell(0x013), 0x34, "... is written");
  b.write(0x015, {0});
}

// B014.0 as the chip goes in and out; each read of 20 bytes sees accesses at other cycles
void shows_accesses(RsuBench& b) {
  int ones = 0;
  for (int i = 0; i < 60; ++i) {
    b.clock(i);
    const int shown = b.read(0x014, 1)[0];
    expect(shown & 0xFE, 0, "B014 without a claim");
    ones += shown;
  }
  expect(ones > 2 && ones < 30, 1, "B014.0 is 1 in some of 60 reads");
}

// A write without claim waits for the access, and none begins before it is done
void unclaimed(unsigned fault) {
  Chip chip;
  chip.write_gap = 0;
  RsuBench b(with(chip, fault));
  for (const int64_t shift : {int64_t{-1}, int64_t{0}, int64_t{1}, int64_t{4}, int64_t{7}, int64_t{8}}) {
    b.clock(300);
    const int64_t s = next_access(b, b.edge + 3000);
    const auto value = static_cast<uint8_t>(0x40 + shift);
    aim(b, s + shift, 6 + 30);
    b.high = 0;
    b.spi(write_telegram(0x600, Bytes(30, value)), 0);
    expect(b.judged, s + shift, "J");
    const int64_t begin = shift > 0 && shift <= 7 ? s + 8 : s + shift;  // own falls at s + 7, which is seen after
    b.run_to(250 * (begin + 29) + 1);
    expect(b.cell(0x61C), value, "the last byte but one");
    expect(b.cell(0x61D) != value, 1, "the last byte is not yet written");
    b.clock();
    expect(b.cell(0x61D), value, "the last byte, at beg + L");
    if (shift <= 0) {
      b.clock();
      expect(b.own.rise, begin + 30, "an overdue access begins at Q");
    }
    b.high = 600;
  }
  // the reply of a read that comes while the chip is in an access
  expect_bytes(b.read(0x600, 3), Bytes(3, 0x48), "read without a claim");
}

// A frame that begins while a write waits is not heard: the start-up access is long enough
void waiting_write(unsigned fault) {
  Chip chip;
  chip.write_gap = 0;
  chip.fault = fault;
  RsuBench b(chip, false);
  b.top.reset_i = 1;
  b.clock(20);
  expect_bytes(b.spi(write_telegram(0x600, {0x5A}), 4), kWritten, "a write in the start-up access");
  expect_bytes(b.spi(read_telegram(0x001, 1), 5), Bytes(5, 0xFF), "a frame while a write waits");
  b.clock(2200);
  expect(b.cell(0x600), 0x5A, "it is written after the start-up access");
  expect_bytes(b.read(0x600, 1), {0x5A}, "and frames are heard again");
}

// Nor is one that begins at the very judgement of that write: XSS is high at one edge only, the first after the last
// bit
void waiting_write_at_judgement(unsigned fault) {
  Chip chip;
  chip.write_gap = 0;
  chip.fault = fault;
  RsuBench b(chip, false);
  b.top.reset_i = 1;
  b.clock(20);
  const Bytes request = write_telegram(0x600, {0x5A});
  int64_t rise = 250 * (b.edge + 5) + 100;
  b.xss(rise - 700, 0);
  for (size_t bit = 0; bit < 8 * request.size(); ++bit, rise += 1250) {
    b.top.mosi_i = static_cast<uint8_t>(request[bit / 8] >> (7 - bit % 8) & 1);
    b.top.eval();
    b.sck(rise, 1);
    if (bit + 1 < 8 * request.size()) b.sck(rise + 600, 0);
  }
  const int64_t first_edge = rise - 1250 + 150;
  b.xss(first_edge - 50, 1);
  b.xss(first_edge + 50, 0);
  b.sck(first_edge + 60, 0);
  b.run_to(first_edge + 900);
  b.lead = 1200;
  expect_bytes(b.spi(read_telegram(0x001, 1), 5), Bytes(5, 0xFF), "a frame at the judgement of a write that waits");
  expect(b.judged, first_edge / 250 + 3, "J of the write, and no other");
  b.clock(2200);
  expect(b.cell(0x600), 0x5A, "that write is written, too");
  expect_bytes(b.read(0x600, 1), {0x5A}, "and frames are heard again after it");
}

// A write that is not done refuses the next
void earlier_write(unsigned fault) {
  Chip chip;
  chip.write_gap = 0;
  RsuBench b(with(chip, fault));
  b.claim();
  b.half = 125;  // 48 MHz, so that only the last bytes of replies are checked
  b.lead = b.lag = b.high = 500;
  for (const size_t data : {size_t{60}, size_t{200}}) {
    b.clock(2000);
    b.spi(write_telegram(0x600, Bytes(data, 0x11)), 0);
    const Bytes reply = b.spi(write_telegram(0x130, {9}), 4);
    expect(reply[3], data == 60 ? kWritten[3] : kRefused[3], "a write some 70 cycles after one of 60 and of 200 bytes");
  }
}

Bytes both_reply(const Bytes& data) { return with_crc(Bytes{0xC1, 0x00} + data); }

// Read and write (SP16)
void both(RsuBench& b) {
  b.claim();
  b.write(0x319, {3, 0xAA, 0xBB, 0xCC});
  b.write(0x00E, {0x07});
  b.write(0x010, {0x40});
  b.release();
  b.clock(200);
  b.claim();
  b.write(0x010, {0x40});
  b.write(0x00E, {0x07});
  // with the DPRAM claimed, so that the chip does not take the inputs at once
  expect_bytes(b.spi(both_telegram({1, 2, 3, 4, 5}), 8), both_reply({3, 0xAA, 0xBB, 0xCC}), "read and write");
  expect_bytes(b.read(0x130, 6), {5, 1, 2, 3, 4, 5}, "inputs");
  expect_bytes(b.read(0x010, 1), {0x41}, "B010.0 is set");
  expect_bytes(b.read(0x00E, 1), {0x06}, "B00E.0 is cleared");
  expect_bytes(b.spi(both_telegram({}), 8), both_reply({3, 0xAA, 0xBB, 0xCC}), "without inputs");
  expect_bytes(b.read(0x130, 2), {0, 1}, "a length byte of 0");
  b.write(0x319, {0});
  expect_bytes(b.spi(both_telegram(Bytes(244, 0x5A)), 5), both_reply({0}), "without outputs, 244 bytes of inputs");
  expect_bytes(b.read(0x223, 3), {0x5A, 0x5A, 0}, "the last of 244 inputs");
  b.write(0x319, {255});
  const Bytes most = b.spi(both_telegram({7}), 249);
  expect(most[2], 244, "a length byte above 244 counts as 244");
  expect_bytes(
      Bytes(most.end() - 2, most.end()),
      [&] {
        const Bytes all = with_crc(Bytes(most.begin(), most.end() - 2));
        return Bytes(all.end() - 2, all.end());
      }(),
      "... and the CRC covers it");
  b.write(0x319, {1});
  b.release();
  b.clock(200);
}

// ... and ownership: refused in an access, and no access until XSS has risen
void both_and_accesses(RsuBench& b) {
  for (int64_t shift = -1; shift < 10; ++shift) {
    b.clock(300);
    const int64_t s = next_access(b, b.edge + 800);
    aim(b, s + shift, 5);
    b.own.rise = -1;
    const bool refused = shift >= 1 && shift <= 7;
    b.high = 0;
    const Bytes reply = b.spi(both_telegram({9}), 5);
    expect(b.judged, s + shift, "J of a read and write");
    expect(reply[0], refused ? 0xE1 : 0xC1, "read and write at a cycle of an access");
    const int64_t rise = b.tick;  // of XSS
    if (!refused) expect(b.own.rise < b.judged, 1, "no access before XSS has risen");
    b.clock(30);
    if (!refused) expect(b.own.rise, rise / 250 + 1 + 2, "an overdue access begins at Y");
    b.high = 600;
  }
}

void u_timer(unsigned fault) {
  Chip chip;
  chip.u_timer = 4800;
  RsuBench b(with(chip, fault));
  const auto judged_frame = [&](const Bytes& telegram) {
    b.spi(telegram, 4);
    return b.judged;
  };
  b.claim();
  b.clock(6000);
  expect(b.host.level, 1, "no U_Timer with B015.0 = 0");
  b.write(0x015, {1});
  judged_frame(read_telegram(0x000, 1));
  b.clock(2000);
  int64_t j = judged_frame(read_telegram(0x000, 1));
  b.wait([&] { return b.host.level == 0; }, 6000);
  expect(b.host.fall, j + 4800, "U_Timer, from the last telegram's judgement on");
  b.clock(2);
  expect(b.own.rise, j + 4800, "an overdue access begins where it ends");
  b.claim();
  Bytes wrong = read_telegram(0x000, 1);
  j = b.judged;
  b.clock(1000);
  wrong.back() ^= 1;
  b.spi(wrong, 4);
  b.wait([&] { return b.host.level == 0; }, 6000);
  expect(b.host.fall, j + 4800, "a wrong CRC does not start it");
  b.claim();
  j = judged_frame(read_telegram(0x800, 1));
  b.wait([&] { return b.host.level == 0; }, 6000);
  expect(b.host.fall, j + 4800, "another error does");
  // a claim judged at its end is granted
  b.claim();
  const int64_t end = b.judged + 4800;
  aim(b, end, 7);
  b.host.fall = -1;
  expect_bytes(b.spi(write_telegram(0x014, {2}), 4), kWritten, "a claim at U_Timer's end");
  expect(b.judged, end, "J at U_Timer's end");
  expect(b.host.fall, -1, "B014.1 stays");
  b.release();
  b.clock(6000);
}

// SP15
void block_crc(unsigned fault) {
  for (const unsigned judged : {0U, 1U}) {
    Chip chip;
    chip.block_crc = judged;
    RsuBench b(with(chip, fault));
    const Bytes block = {16, 5, 0x0C, 0xC9, 0x0F, 0, 0, 4, 4, 20, 20, 0, 4, 1, 2, 0x13, 0x23};
    b.claim();
    b.write(0x020, block);
    b.write(0x010, {4});
    b.release();
    b.clock(200);
    expect(b.ready.level, !judged, "initialisation without a CRC");
    expect_bytes(b.read(0x00A, 2), {static_cast<uint8_t>(!judged), static_cast<uint8_t>(judged)}, "B00A, B00B");
    if (!judged) continue;
    b.claim();
    b.write(0x0F7, cells(crc16(block)));
    b.write(0x010, {4});
    b.release();
    b.clock(200);
    expect(b.ready.level, 1, "initialisation with one");
  }
}

}  // namespace

void rsu_owner(unsigned fault) {
  {
    RsuBench b(with({}, fault));
    claims(b);
    claims_among_others(b);
    shows_accesses(b);
    both(b);
    both_and_accesses(b);
  }
  unclaimed(fault);
  waiting_write(fault);
  waiting_write_at_judgement(fault);
  earlier_write(fault);
  u_timer(fault);
  block_crc(fault);
}

}  // namespace rtl

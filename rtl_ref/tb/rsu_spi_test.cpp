// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The SPI port (section 5 of microarchitecture_rsu.md): bits, frames, telegrams, errors, replies.
#include "rsu_bench.hpp"

namespace rtl {
namespace {

const Bytes kSilence4 = {0xFF, 0xFF, 0xFF, 0xFF};

Bytes error(unsigned code, unsigned adr = 1) { return with_crc(one(0xE0 + adr) + one(code)); }

// Section 10, to the tick
void example(unsigned fault) {
  Chip chip;
  chip.fault = fault;
  RsuBench b(chip, false);
  expect(b.miso.back().level, 2, "MISO is Z during reset");
  expect(b.top.txd_o, 1, "TXD in SPI mode");
  b.top.reset_i = 1;
  b.clock(100);
  expect(b.own.rise, 10, "start-up access begins at R");
  b.run_to(1000000);
  expect(b.own.fall, 10 + 2055 + 48 * 40 + 7, "accesses go on");
  b.tick = 999999;
  b.miso = {{0, 2}};
  expect_bytes(b.spi({0x01, 0x00, 0x14, 0x01, 0x18, 0xCF}, 5), {0x81, 0x00, 0x00, 0xE8, 0x21}, "example of SPI");
  expect(b.last_rise, 1057000, "rise 48");
  expect(b.judged, 4232, "J of the example");
  const std::vector<Change> wanted = {{0, 2},       {1000000, 1}, {1058800, 0}, {1066000, 1}, {1067200, 0},
                                      {1086400, 1}, {1090000, 0}, {1091200, 1}, {1092400, 0}, {1098400, 1},
                                      {1099600, 0}, {1104400, 1}, {1106200, 2}};
  expect(static_cast<int64_t>(b.miso.size()), static_cast<int64_t>(wanted.size()), "changes of MISO");
  for (size_t i = 0; i < wanted.size() && i < b.miso.size(); ++i) {
    expect(b.miso[i].tick, wanted[i].tick, "tick of MISO's register");
    expect(b.miso[i].level, wanted[i].level, "level of MISO");
  }
}

Bytes counted(size_t count) {
  Bytes bytes;
  for (size_t i = 0; i < count; ++i) bytes.push_back(static_cast<uint8_t>(i * 7 + 3));
  return bytes;
}

void cells_and_errors(RsuBench& b) {
  expect_bytes(b.read(0x000, 5), {1, 0x0D, 7, 1, 0}, "version");
  b.claim();
  expect_bytes(b.read(0x014, 1), {2}, "B014 of a host that owns");
  for (const size_t count : {size_t{1}, size_t{245}}) {
    b.write(0x700, counted(count));
    expect_bytes(b.read(0x700, count), counted(count), "what the host wrote");
  }
  b.release();
  const auto reply = [&](const Bytes& telegram, const Bytes& wanted, const char* what) {
    expect_bytes(b.spi(telegram, wanted.size()), wanted, what);
  };
  Bytes wrong = read_telegram(0x000, 5);
  wrong.back() ^= 1;
  reply(wrong, error(1), "low byte of the CRC");
  wrong.back() ^= 1;
  wrong[4] ^= 0x80;
  reply(wrong, error(1), "high byte of the CRC");
  wrong = read_telegram(0x8000, 0);
  wrong.back() ^= 1;
  reply(wrong, error(1), "a wrong CRC hides the other errors");
  reply(read_telegram(0x0800, 1), error(2), "address above 7FF");
  reply(read_telegram(0x8000, 1), error(2), "bit 15 of the address");
  reply(read_telegram(0x000, 0), error(4), "nothing to read");
  reply(read_telegram(0x000, 246), error(4), "246 bytes to read");
  reply(read_telegram(0x7FF, 2), error(4), "data beyond B7FF");
  reply(read_telegram(0x1000, 0), error(6), "address and length");
  reply(write_telegram(0x700, {}), error(4), "nothing to write");
  reply(write_telegram(0x7FF, {1, 2}), error(4), "a write beyond B7FF");
  reply(write_telegram(0x100, counted(246)), error(12), "246 bytes to write");
  reply(write_telegram(0x900, counted(255)), error(14), "255 bytes to write");
  reply(both_telegram(counted(245)), error(4), "245 input bytes");
  reply(both_telegram(counted(248)), error(12), "248 input bytes");
  expect_bytes(b.read(0x7FF, 1), {0}, "nothing of a wrong telegram is written");
  reply(read_telegram(0x000, 1, 2), kSilence4, "another card");
  reply(with_crc({0x09, 0x00, 0x14, 0x01}), kSilence4, "bit 3 of the start byte");
  reply(with_crc({0x61, 0x00, 0x14, 0x01}), kSilence4, "command 3");
  reply(with_crc({0x81, 0x00, 0x14, 0x01}), kSilence4, "command 4");
  const Bytes longer = b.spi(read_telegram(0x000, 2), 9);
  expect_bytes(longer, with_crc({0x81, 0, 1, 0x0D}) + Bytes{0xFF, 0xFF, 0xFF}, "FF after the reply");
}

// Frames that end too soon, and bits without a frame
void frames(RsuBench& b) {
  const Bytes write = write_telegram(0x600, {0x77});
  b.claim();
  expect_bytes(b.spi(Bytes(write.begin(), write.end() - 1), 0), {}, "a frame without its last byte");
  b.run_to(b.tick + 40000);
  expect(b.cell(0x600), 0, "a telegram that is cut has no effect");
  b.spi(write, 0);
  b.run_to(b.tick + 40000);
  expect(b.cell(0x600), 0x77, "one whose reply is cut is carried out");
  // an unfinished byte is lost, and the next frame begins with its bit 7
  b.xss(b.tick + 1000, 0);
  for (int i = 0; i < 5; ++i) {
    b.sck(b.tick + 600, 1);
    b.sck(b.tick + 600, 0);
  }
  b.xss(b.tick + 600, 1);
  b.run_to(b.tick + 600);
  expect_bytes(b.read(0x600, 1), {0x77}, "after five bits");
  // SCK without XSS is nothing
  for (int i = 0; i < 9; ++i) {
    b.sck(b.tick + 600, 1);
    b.sck(b.tick + 600, 0);
  }
  expect_bytes(b.read(0x600, 1), {0x77}, "after bits without XSS");
  // at the tick of XSS's rise an edge counts, at that of its fall it does not
  const int64_t begin = 250 * (b.edge + 20);
  b.sck(begin, 1);
  b.xss(begin, 0);
  b.sck(begin + 600, 0);
  expect(b.top.miso_o, 1, "a rise at XSS's fall does not count");
  b.xss(begin + 1200, 1);
  b.run_to(begin + 2400);
  expect_bytes(b.read(0x600, 1), {0x77}, "after an edge at XSS's fall");
  // XSS rises when a reply has begun: the next frame hears FF until its own
  b.spi(read_telegram(0x600, 1), 1);
  expect_bytes(b.spi({0x02, 0x00, 0x00, 0x01, 0x00, 0x00}, 4), kSilence4, "nothing of the last reply is left");
  b.release();
}

// 2.7 us after a write (SP9), at each phase of CLK
void write_gap(unsigned fault) {
  Chip chip;
  chip.fault = fault;
  RsuBench b(chip);
  b.lag = 200;
  b.claim();
  for (int phase = 0; phase < 250; phase += 7) {
    for (const int64_t gap : {32400, 31749}) {
      b.tick += 40000 + phase + 1;
      b.high = 0;
      b.spi(write_telegram(0x600, {1}), 0);
      b.tick = b.last_rise + gap - 1;
      const Bytes reply = b.spi(read_telegram(0x600, 1), 5);
      expect_bytes(reply, gap == 32400 ? with_crc({0x81, 0, 1}) : kSilence4 + Bytes{0xFF},
                   gap == 32400 ? "2.7 us after a write" : "too soon after a write");
    }
  }
  // and to the cycle: X at H + 127 is not heard, at H + 128 it is
  for (const int64_t cycles : {127, 128}) {
    b.tick += 40000;
    b.spi(write_telegram(0x600, {1}), 0);
    const int64_t h = b.judged - 1;
    b.tick = 250 * (h + cycles - 3) + 124;
    const Bytes reply = b.spi(read_telegram(0x600, 1), 5);
    expect(reply[0], cycles == 128 ? 0x81 : 0xFF, "X at the gap's end");
  }
}

// The reply begins later (SP6), addresses of cards, the other mode
void variants(unsigned fault) {
  for (const unsigned gap : {1U, 2U, 16U}) {
    Chip chip;
    chip.fault = fault;
    chip.reply_gap = gap;
    chip.adr = 2;
    RsuBench b(chip);
    expect_bytes(b.spi(read_telegram(0x001, 3, 2), 7 + gap), Bytes(gap, 0xFF) + with_crc({0x82, 0, 0x0D, 7, 1}),
                 "reply after a gap");
    expect_bytes(b.spi(read_telegram(0x800, 3, 2), 4 + gap), Bytes(gap, 0xFF) + error(2, 2), "error after a gap");
  }
  for (const unsigned adr : {0U, 3U}) {
    Chip chip;
    chip.fault = fault;
    chip.adr = adr;
    RsuBench b(chip);
    expect_bytes(b.spi(read_telegram(0x001, 3, adr), 4), kSilence4, "no telegram is for address 0 or 3");
  }
  for (const unsigned mode : {0U, 2U, 3U}) {
    Chip chip;
    chip.fault = fault;
    chip.mode = mode;
    RsuBench b(chip, false);
    b.top.r_req_i = 1;
    b.top.reset_i = 1;
    b.clock(100);
    b.top.mode_i = 1;  // too late
    expect(b.own.rise, mode == 2 ? 10 : -1, "R_REQ holds the start-up access off in parallel mode only");
    expect(b.top.l_req_o | b.top.l_sta_o, 0, "L_REQ and L_STA");
    b.spi(read_telegram(0x000, 1), 4);
    expect(static_cast<int64_t>(b.miso.size()), 1, "MISO stays Z");
    b.top.r_req_i = 0;
    b.clock(4);
    expect(b.top.l_req_o, mode != 2, "L_REQ is of the parallel port");
    b.top.csr_i = b.top.rd_i = 0;
    b.top.eval();
    b.clock(2);
    expect(b.top.d_oe_o, mode != 2, "D is driven by the parallel port only");
  }
}

// Before the start-up access has ended all cells but B014 are read as 00 (SP14)
void early_reads(unsigned fault) {
  Chip chip;
  chip.fault = fault;
  RsuBench b(chip, false);
  b.top.reset_i = 1;
  b.clock(20);
  expect_bytes(b.read(0x000, 1), {0}, "a read in the start-up access");
  expect_bytes(b.read(0x014, 1), {1}, "B014 in the start-up access");
  expect_bytes(b.spi(write_telegram(0x014, {2}), 4), error(0), "a claim in the start-up access");
  b.clock(2000);
  expect_bytes(b.read(0x000, 1), {1}, "a read after it");
  // XSS low since before R: not before it has been high
  b.top.reset_i = 0;
  b.xss(b.tick + 1000, 0);
  b.top.reset_i = 1;
  b.clock(20);
  expect(b.top.miso_oe_o, 0, "a frame that began before R");
  b.xss(b.tick + 1000, 1);
  b.clock(3000);
  expect_bytes(b.read(0x000, 1), {1}, "a frame after it");
}

// SCK at 24 MHz and 48 MHz: not legal (SP2), but ruled. Some bits of the first byte are sent before it is loaded.
void fast(RsuBench& b) {
  const Bytes wanted = with_crc({0x81, 0x00, 0x0D, 7, 1});
  for (const int64_t half : {250, 125}) {
    b.half = half;
    for (int phase = 0; phase < 250; phase += 11) {
      b.tick += phase;
      const Bytes reply = b.spi(read_telegram(0x001, 3), 7);
      expect_bytes(Bytes(reply.begin() + 1, reply.end()), Bytes(wanted.begin() + 1, wanted.end()),
                   "a read with a fast SCK, but for its first byte");
    }
  }
  b.half = 600;
}

}  // namespace

void rsu_spi(unsigned fault) {
  example(fault);
  Chip chip;
  chip.fault = fault;
  RsuBench b(chip);
  b.tick += 17;
  b.half = 603;
  cells_and_errors(b);
  frames(b);
  fast(b);
  write_gap(fault);
  variants(fault);
  early_reads(fault);
}

}  // namespace rtl

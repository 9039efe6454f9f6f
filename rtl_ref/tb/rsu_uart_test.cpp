// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The UART port (sections 6.1 to 6.3, 6.5): rates, characters, silence, errors, half duplex, the DPRAM as one.
#include "rsu_bench.hpp"

namespace rtl {
namespace {

Bytes error(unsigned code, unsigned adr = 1) { return with_crc(one(0xE0 + adr) + one(code)); }

Chip with(Chip chip, unsigned fault) {
  chip.mode = 2;
  chip.fault = fault;
  return chip;
}

// The edge of the reply's first start bit when the commit does not delay it
int64_t reply_at(const RsuBench& b, int64_t tsdr = 11) { return b.last_start + 11 * b.bit - 2 + tsdr * b.bit; }

void rates(unsigned fault) {
  for (unsigned ubr = 0; ubr < 8; ++ubr) {
    Chip chip;
    chip.ubr = ubr;
    chip.adr = 1 + ubr % 2;
    RsuBench b(with(chip, fault));
    expect_bytes(b.ask(read_telegram(0x001, 1, chip.adr)), with_crc(one(0x80 + chip.adr) + Bytes{0, 0x0D}),
                 "read at a rate");
    expect(b.judged, b.last_start + b.bit / 2 + 10 * b.bit + 1, "J");
    expect(b.reply_start, reply_at(b), "first start bit");
    if (fault != 0 && ubr == 0) break;
  }
}

Bytes counted(size_t count) {
  Bytes bytes;
  for (size_t i = 0; i < count; ++i) bytes.push_back(static_cast<uint8_t>(i * 5 + 1));
  return bytes;
}

void cells_and_errors(RsuBench& b) {
  const Bytes most = counted(250);
  b.uart_write(0x600, most);
  expect_bytes(b.uart_read(0x600, 245), counted(245), "what the host wrote");
  expect_bytes(b.uart_read(0x6F5, 5), Bytes(most.end() - 5, most.end()), "its last bytes");
  b.uart_write(0x014, {0x5A});
  expect_bytes(b.uart_read(0x014, 1), {0x5A}, "B014 is plain RAM");
  Bytes wrong = read_telegram(0x000, 5);
  wrong.back() ^= 1;
  expect_bytes(b.ask(wrong), error(1), "low byte of the CRC");
  expect_bytes(b.ask(read_telegram(0x0900, 1)), error(2), "address above 7FF");
  expect_bytes(b.ask(read_telegram(0x000, 0)), error(4), "nothing to read");
  expect_bytes(b.ask(read_telegram(0x000, 246)), error(4), "246 bytes to read");
  expect_bytes(b.ask(read_telegram(0x7FF, 2)), error(4), "data beyond B7FF");
  expect_bytes(b.ask(write_telegram(0x000, {})), error(4), "nothing to write");
  expect_bytes(b.ask(write_telegram(0x100, counted(251))), error(12), "251 bytes to write");
  expect(b.cell(0x100), 0, "nothing of them is written");
}

void expect_silent(RsuBench& b, const Bytes& telegram, const char* what) { expect_bytes(b.ask(telegram), {}, what); }
void expect_heard(RsuBench& b, const char* what) {
  expect_bytes(b.ask(read_telegram(0x001, 1)), with_crc({0x81, 0, 0x0D}), what);
}

// A spoilt telegram makes deaf until a silence of the interval; another card's does not
void characters(RsuBench& b) {
  const Bytes read = read_telegram(0x001, 1);
  b.send(read_telegram(0x001, 1, 2));
  expect_heard(b, "right after another card's telegram");
  b.send(write_telegram(0x600, Bytes(20, 0x01), 2));
  expect_heard(b, "right after another card's longer telegram");
  for (const int at : {0, 3}) {
    b.wrong_parity_at = at;
    b.send(read);
    b.wrong_parity_at = -1;
    expect_silent(b, read, "right after wrong parity");
    b.clock(3000);
    expect_heard(b, "a silence after wrong parity");
    b.no_stop_at = at;
    b.send(read);
    b.no_stop_at = -1;
    expect_silent(b, read, "right after a character without stop bit");
    b.clock(3000);
    expect_heard(b, "a silence after that");
  }
  for (const uint8_t start : {0x05, 0x61, 0x81}) {
    b.send(with_crc({start, 0x00, 0x01, 0x01}));
    expect_silent(b, read, "right after what is no telegram's start");
    b.clock(3000);
    expect_heard(b, "a silence after that");
  }
  // a glitch is not a character
  b.top.rxd_i = 0;
  b.clock(12);
  b.top.rxd_i = 1;
  b.clock(40);
  expect_heard(b, "after a glitch");
  // RXD low for long
  b.top.rxd_i = 0;
  b.clock(1000);
  b.top.rxd_i = 1;
  b.clock(7 * 143 - 1);
  expect_silent(b, read, "a break's silence, too short");
  b.clock(3000);
  b.top.rxd_i = 0;
  b.clock(1000);
  b.top.rxd_i = 1;
  b.clock(7 * 143 + 2);
  expect_heard(b, "a break's silence");
}

// A pause of exactly the interval within a telegram is none too long, a cycle more is
void interval(RsuBench& b, unsigned halves, const char* what) {
  const int64_t g = static_cast<int64_t>(halves) * 11 * b.bit / 2;
  b.pause_at = 2;
  for (const int64_t more : {1, 2}) {
    b.pause = g + more;
    expect_bytes(b.ask(read_telegram(0x001, 1)), more == 1 ? with_crc({0x81, 0, 0x0D}) : Bytes{}, what);
    b.clock(g + 300);
  }
  b.pause_at = -1;
}

void intervals(unsigned fault) {
  const std::array<unsigned, 8> halves = Chip{}.gaps;
  for (unsigned code = 0; code < 8; ++code) {
    Chip chip;
    chip.uiv = code;
    RsuBench b(with(chip, fault));
    interval(b, halves[code], "pause of the strap's interval");
    if (code != 2) continue;
    for (const unsigned changed : {1U, 5U}) {
      b.uart_write(0x019, one(changed));
      interval(b, halves[changed], "pause of B019's interval");
    }
    for (const unsigned none : {0U, 8U}) {
      b.uart_write(0x019, one(none));
      interval(b, halves[code], "B019 without a code: the strap's");
    }
  }
  for (const unsigned ubr : {3U, 4U}) {  // odd bit times
    for (const unsigned code : {0U, 1U}) {
      Chip chip;
      chip.ubr = ubr;
      chip.uiv = code;
      chip.gaps = {1, 2, 4, 10, 20, 40, 100, 200};
      RsuBench b(with(chip, fault));
      interval(b, chip.gaps[code], "pause at a rate whose bit time is odd");
      if (fault != 0) return;
    }
  }
}

void tsdr(RsuBench& b) {
  for (const unsigned value : {50U, 5U, 255U, 0U}) {
    b.uart_write(0x01A, one(value));
    expect_heard(b, "read with another TSDR");
    expect(b.reply_start, reply_at(b, value < 11 ? 11 : value), "first start bit after B01A's TSDR");
  }
}

// From the judgement to the end of the reply nothing is heard, and a character that falls at E is lost; one that falls
// at E + 1 is not
void half_duplex(RsuBench& b) {
  const Bytes read = read_telegram(0x001, 1);
  for (const int64_t late : {0, 1}) {
    b.send(read);
    const int64_t end = reply_at(b) + 11 * b.bit * 5;
    b.send(Bytes(3, 0x01));  // while TSDR runs and the reply is sent
    while (b.edge + 3 < end + late) b.clock();
    expect(b.top.txd_o, 1, "end of the reply");
    const Bytes reply = b.ask(read);
    expect_bytes(reply, late == 1 ? with_crc({0x81, 0, 0x0D}) : Bytes{},
                 late == 1 ? "a request at E + 1" : "a request at E");
    b.clock(3000);
  }
}

// A telegram waits for the access that runs, and none begins before it is done (UA6)
void with_accesses(RsuBench& b) {
  for (int64_t shift = -1; shift < 10; ++shift) {
    b.clock(300);
    while ((b.edge + 3 + 6 * 286 + 274 - shift - b.own.rise) % 48 != 0) b.clock();
    const auto value = static_cast<uint8_t>(0x80 + shift);
    b.send(write_telegram(0x610, {value}));
    const int64_t j = b.judged;
    const bool waits = shift > 0 && shift <= 7;
    const int64_t begin = waits ? j - shift + 8 : j;
    expect(b.last_start + 274, j, "J");
    // the last character's stop bit lasts longer than the commit: it is over
    expect(b.cell(0x610), value, "written");
    if (shift == 0 || shift == -1)
      expect(b.own.rise < begin || b.own.rise >= begin + 1, 1, "no access before the commit is done");
    expect_bytes(b.receive(), {0xA1, 0x00, 0x20, 0x78}, "reply");
  }
  // to the cycle, with more bytes than the stop bit has cycles
  for (const int64_t shift : {0, 3, 9}) {
    b.clock(300);
    while ((b.edge + 3 + 45 * 286 + 274 - shift - b.own.rise) % 48 != 0) b.clock();
    const auto value = static_cast<uint8_t>(0x20 + shift);
    b.send(write_telegram(0x610, Bytes(40, value)));
    const int64_t j = b.judged, s = j - shift;
    const int64_t begin = shift == 3 ? s + 8 : j;
    b.clock(begin + 39 - b.edge);
    expect(b.cell(0x636), value, "the last byte but one");
    expect(b.cell(0x637) != value, 1, "the last byte is not yet written");
    b.clock();
    expect(b.cell(0x637), value, "the last byte, at beg + L");
    b.clock();
    if (shift == 0) expect(b.own.rise, begin + 40, "an overdue access begins at Q");
    b.receive();
  }
}

// The start-up access is longer than TSDR: the reply begins when it is ready
void early(unsigned fault) {
  Chip chip;
  chip.mode = 2;
  chip.fault = fault;
  RsuBench b(chip, false);
  b.top.reset_i = 1;
  b.clock(10);
  expect_bytes(b.ask(read_telegram(0x000, 4)), with_crc({0x81, 0, 1, 0x0D, 7, 1}), "read in the start-up access");
  expect(b.reply_start, 10 + 2054 + 1 + 4 + 1, "first start bit after the commit");
  for (const unsigned adr : {0U, 3U}) {
    chip.adr = adr;
    RsuBench c(with(chip, fault));
    expect_bytes(c.ask(read_telegram(0x000, 1, adr)), {}, "no telegram is for address 0 or 3");
  }
}

}  // namespace

void rsu_uart(unsigned fault) {
  {
    RsuBench b(with({}, fault));
    cells_and_errors(b);
    characters(b);
    tsdr(b);
    half_duplex(b);
    with_accesses(b);
  }
  early(fault);
  intervals(fault);
  rates(fault);
}

}  // namespace rtl

// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Exchanges over UART (section 6.4; UA7 to UA14): areas, what the reply carries, errors, and the worked example to the
// cycle.
#include "rsu_bench.hpp"

namespace rtl {
namespace {

Chip with(Chip chip, unsigned fault) {
  chip.mode = 2;
  chip.fault = fault;
  return chip;
}

Bytes reply(unsigned function, int area, const Bytes& data) {
  return with_crc(one(1) + one(function) + cells(area) + one(data.size()) + data);
}
Bytes error(unsigned function, unsigned code) { return with_crc(one(1) + one(function) + one(code)); }

// Section 10; there S is 10000
void example(unsigned fault) {
  RsuBench b(with({}, fault));
  b.to_data_exchange([&](int address, const Bytes& data) { b.uart_write(address, data); });
  b.bus(sd2({5, 2, 0x4D, 0xAA}));
  b.uart_write(0x00E, {1});
  b.clock(300);
  expect_bytes(b.uart_read(0x319, 2), {1, 0xAA}, "outputs");
  while ((b.edge + 3 - b.own.rise) % 48 != 2) b.clock();
  const int64_t s = b.edge + 3;
  const auto at = [&](int64_t cycle) { b.clock(s + cycle - 10000 - b.edge); };
  const Bytes telegram = {0x41, 0x00, 0x01, 0x30, 0x02, 0x01, 0x55, 0xAB, 0x18};
  b.send(Bytes(telegram.begin(), telegram.end() - 1));
  // the last character by hand, to look on from J
  const uint8_t last = telegram.back();
  int parity = 0;
  const auto put = [&](int level) {
    b.top.rxd_i = static_cast<uint8_t>(level);
    b.clock(26);
  };
  put(0);
  for (int i = 0; i < 8; ++i) {
    put(last >> i & 1);
    parity ^= last >> i & 1;
  }
  put(parity);
  b.top.rxd_i = 1;
  at(12562);
  expect(b.judged - s, 2562, "J");
  at(12565);
  expect(b.cell(0x130), 0, "B130 before its write");
  at(12566);
  expect(b.cell(0x130), 1, "B130");
  expect(b.cell(0x131), 0, "B131 before its write");
  at(12567);
  expect(b.cell(0x131), 0x55, "B131");
  expect(b.cell(0x010), 0, "B010 before its write");
  at(12568);
  expect(b.cell(0x010), 1, "B010");
  at(12571);
  expect(b.cell(0x00E), 1, "B00E before its write");
  at(12572);
  expect(b.cell(0x00E), 0, "B00E at Q");
  expect_bytes(b.receive(), {0x01, 0x01, 0x03, 0x19, 0x02, 0x01, 0xAA, 0x62, 0x69}, "example of UART");
  expect(b.reply_start - s, 2858, "TXD falls");
  expect(b.edge - s, 5432, "E");
  expect_bytes(b.ask(exchange_telegram(0, 0x100, {1})), error(0x81, 2), "an error in DATA_EXCH");
}

void news(RsuBench& b) {
  b.uart_write(0x319, {2, 0xA1, 0xA2});
  b.uart_write(0x410, {3, 0xB1, 0xB2, 0xB3});
  b.uart_write(0x500, {4, 5, 2, 0xC1, 0xC2});
  b.uart_write(0x5D0, {0x5E, 1, 2, 200, 0xD1});
  b.uart_write(0x6D0, {0x51, 3, 4, 2, 0xE1, 0xE2});
  b.uart_write(0x00E, {0x87, 0x83});
  const Bytes inputs = exchange_telegram(0, 0x130, {2, 0x71, 0x72});
  const auto expect_news = [&](const Bytes& wanted, int e, int v, const char* what) {
    expect_bytes(b.ask(inputs), wanted, what);
    expect(b.cell(0x00E), e, "B00E after it");
    expect(b.cell(0x00F), v, "B00F after it");
  };
  expect_bytes(b.ask(exchange_telegram(2, 0x227, {0x01, 0x00})), reply(0, 0x319, {2, 0xA1, 0xA2}),
               "an exchange of a diagnosis carries the outputs");
  expect(b.cell(0x00E), 0x87, "and clears nothing");
  expect_news(reply(0x10, 0x410, {3, 0xB1, 0xB2, 0xB3}), 0x85, 0x83, "parameters first");
  expect_news(reply(0x20, 0x500, {4, 5, 2, 0xC1, 0xC2}), 0x81, 0x83, "configuration");
  expect_news(reply(0x04, 0x5D0, {0x5E, 1, 2, 200}), 0x81, 0x82, "C1 request, a read");
  expect_news(reply(0x08, 0x6D0, {0x51, 3, 4, 2, 0xE1, 0xE2}), 0x81, 0x80, "C2 request, with data");
  expect_news(reply(0, 0x319, {2, 0xA1, 0xA2}), 0x80, 0x80, "outputs");
  expect_news(reply(0, 0x319, {2, 0xA1, 0xA2}), 0x80, 0x80, "outputs that are not new");
  expect(b.cell(0x132), 0x72, "inputs");
}

// Lengths of areas that are above their limits
void limits(RsuBench& b) {
  const Bytes inputs = exchange_telegram(0, 0x130, {0});
  b.uart_write(0x319, {255});
  Bytes got = b.ask(inputs);
  expect(static_cast<int64_t>(got.size()), 7 + 245, "outputs of 244 bytes at most");
  expect(got[4] << 8 | got[5], 245 << 8 | 244, "their number and length byte");
  expect_bytes(got, with_crc(Bytes(got.begin(), got.end() - 2)), "their CRC");
  b.uart_write(0x410, {238});
  b.uart_write(0x502, {201});
  b.uart_write(0x5D0, {0x5F, 1, 1, 241});
  b.uart_write(0x00E, {6, 1});
  for (const int most : {237, 200, 240}) {
    got = b.ask(inputs);
    const size_t header = most == 237 ? 1 : most == 200 ? 3 : 4;
    expect(got.size() > 5 + header ? got[4 + header] : -1, most, "an area's limit");
    expect(static_cast<int64_t>(got.size()), static_cast<int64_t>(7 + header) + most, "bytes of the reply");
  }
}

// Flags by area, and the areas' sizes
void areas(RsuBench& b) {
  struct Area {
    int address, flags, bit;
    size_t size;
  };
  for (const Area& area : {Area{0x130, 0x010, 1, 245}, Area{0x227, 0x010, 2, 240}, Area{0x5D0, 0x011, 1, 244},
                           Area{0x6D0, 0x011, 2, 244}}) {
    b.send(exchange_telegram(2, area.address, {0x99}));
    expect(b.cell(area.flags) & 3, area.bit, "the area's flag");
    b.receive();
    expect(b.cell(area.address), 0x99, "the area's first byte");
    expect_bytes(b.ask(exchange_telegram(2, area.address, Bytes(area.size + 1, 1))), error(0x80, 4), "a byte too many");
  }
  b.uart_write(0x319, {0});
  expect_bytes(b.ask(exchange_telegram(2, 0x227, Bytes(240, 0x42))), reply(0, 0x319, {0}),
               "a diagnosis of the area's size");
  expect(b.cell(0x316) << 8 | b.cell(0x317), 0x4200, "its last byte");
  expect_bytes(b.ask(exchange_telegram(0xFD, 0x227, {1})), error(0x80, 2), "diagnosis without function bit 1");
  expect_bytes(b.ask(exchange_telegram(0, 0x227, Bytes(241, 1))), error(0x80, 6), "... and too long");
  expect_bytes(b.ask(exchange_telegram(0, 0x131, {1})), error(0x80, 2), "no area");
  expect_bytes(b.ask(exchange_telegram(0, 0x930, Bytes(246, 1))), error(0x80, 2), "high bits of the address");
  expect_bytes(b.ask(exchange_telegram(0, 0x930, {})), error(0x80, 6), "... and no data");
  expect_bytes(b.ask(exchange_telegram(0, 0x130, Bytes(251, 1))), error(0x80, 12), "longer than 257 bytes");
  Bytes wrong = exchange_telegram(0, 0x130, {1});
  wrong.back() ^= 1;
  expect_bytes(b.ask(wrong), error(0x80, 1), "CRC");
}

void cfg_length(unsigned fault) {
  Chip chip;
  chip.cfg_length = 1;
  RsuBench b(with(chip, fault));
  b.uart_write(0x500, {4, 5, 2, 0xC1, 0xC2});
  b.uart_write(0x00E, {4});
  expect_bytes(b.ask(exchange_telegram(0, 0x130, {0})), with_crc({1, 0x20, 5, 0, 3, 4, 5, 2, 0xC1, 0xC2}),
               "number of the configuration's bytes");
}

}  // namespace

void rsu_exchange(unsigned fault) {
  {
    RsuBench b(with({}, fault));
    news(b);
    areas(b);
    limits(b);
  }
  example(fault);
  cfg_length(fault);
}

}  // namespace rtl

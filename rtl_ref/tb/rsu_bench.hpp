// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The bench of DSDPV1-RSU's own test: pins by the tick of 1/12 ns (edge n of CLK is at tick 250 n), a host with SPI and
// one with UART, and a bus that only sends.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "Vdsdpv1_rsu.h"
#include "Vdsdpv1_rsu___024root.h"
#include "rtl_expect.hpp"

namespace rtl {

// Straps and parameters of a run
struct Chip {
  unsigned mode = 1, adr = 1, ubr = 7, uiv = 0;
  unsigned reply_gap = 0, write_gap = 128, block_crc = 0, u_timer = 0, min_tsdr = 11, cfg_length = 0, fault = 0;
  std::array<unsigned, 8> gaps = {7, 2, 4, 10, 20, 40, 100, 200};
};

struct Change {
  int64_t tick;
  int level;  // 2: Z
};

inline Bytes with_crc(Bytes bytes) {
  const uint16_t crc = crc16(bytes);
  bytes.push_back(static_cast<uint8_t>(crc >> 8));
  bytes.push_back(static_cast<uint8_t>(crc));
  return bytes;
}
inline Bytes operator+(Bytes first, const Bytes& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}
inline Bytes cells(int address) { return {static_cast<uint8_t>(address >> 8), static_cast<uint8_t>(address)}; }
inline Bytes one(size_t value) { return {static_cast<uint8_t>(value)}; }

inline Bytes read_telegram(int address, size_t count, unsigned adr = 1) {
  return with_crc(one(adr) + cells(address) + one(count));
}
inline Bytes write_telegram(int address, const Bytes& data, unsigned adr = 1) {
  return with_crc(one(0x20 + adr) + cells(address) + one(data.size()) + data);
}
inline Bytes both_telegram(const Bytes& data) { return with_crc(one(0x41) + one(data.size()) + data); }
inline Bytes exchange_telegram(unsigned function, int address, const Bytes& data) {
  return with_crc(one(0x41) + one(function) + cells(address) + one(data.size()) + data);
}

class RsuBench {
 public:
  explicit RsuBench(const Chip& chip, bool starts = true);  // `starts`: to the end of the start-up access

  // ---- time
  void clock(int64_t cycles = 1);
  void run_to(int64_t to);  // the edges strictly before it
  bool wait(const std::function<bool()>& until, int64_t limit);
  void start_up();  // RESET rises: R is edge 10; to the end of the start-up access

  // ---- SPI
  void xss(int64_t at, int level);
  void sck(int64_t at, int level);
  Bytes spi(const Bytes& request,
            size_t reply_bytes);          // one frame at `tick`, which then stands where the next may begin
  Bytes read(int address, size_t count);  // with their replies' form
  void write(int address, const Bytes& data);
  bool claim();
  void release() { write(0x014, {0}); }

  // ---- UART
  void send_character(uint8_t byte);
  void send(const Bytes& telegram);
  Bytes receive();  // the reply; empty when none begins
  Bytes ask(const Bytes& telegram);
  Bytes uart_read(int address, size_t count);
  void uart_write(int address, const Bytes& data);

  // ---- PROFIBUS at 12 Mbit/s
  void bus(const Bytes& telegram);
  void to_data_exchange(const std::function<void(int, const Bytes&)>& write);

  int cell(int address) const;
  int owns() const { return top.rootp->dsdpv1_rsu__DOT__u_sequencer__DOT__own_q; }
  int host_owns() const { return top.rootp->dsdpv1_rsu__DOT__u_serial_port__DOT__u_ownership__DOT__host_q; }

  Vdsdpv1_rsu top;
  int64_t edge = -1, tick = 0;
  int64_t half = 600, lead = 600, lag = 600, high = 600;  // ticks of the SPI host
  int64_t bit = 26;                                       // cycles of the UART
  int wrong_parity_at = -1, no_stop_at = -1, pause_at = -1;
  int64_t pause = 0;
  // what was seen
  std::vector<Change> miso;
  Pin own, host, txd, ready, pbf, intr;
  int64_t judged = -1;      // J of the last telegram
  int64_t last_rise = 0;    // tick of the request's last bit
  int64_t last_start = 0;   // S of the last character sent
  int64_t reply_start = 0;  // TXD's first fall of the last reply
  Bytes bus_answer;

 private:
  void rise(int sck_level);
  void see();
  void see_miso(int64_t at);
  void put_bus(int level);
};

// Groups of tests, a chip each or several; `fault` is one of dsdpv1_rsu/faults.txt or 0
void rsu_spi(unsigned fault);
void rsu_owner(unsigned fault);
void rsu_uart(unsigned fault);
void rsu_exchange(unsigned fault);

}  // namespace rtl

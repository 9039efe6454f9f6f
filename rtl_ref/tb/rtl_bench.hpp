// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The bench of the RTL's own test: pins and user port of the chip under Verilator, and a line that sends telegrams and
// reads answers.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "Vdsdpv1.h"
#include "rtl_expect.hpp"
#include "verilated.h"

namespace rtl {

// What the command line chooses: parameters of the chip, which without DSDPV1_RUN_TIME_LIMITS are those that run.sh
// builds it with
struct Limits {
  unsigned rts_lead = 4, rts_trail = 4, search_window_ms = 50;
};
inline Limits limits;

class Bench {
 public:
  explicit Bench([[maybe_unused]] unsigned fault = 0) {
#ifdef SINGLE_FAULTS
    top_.fault_i = static_cast<uint8_t>(fault);
#endif
#ifdef DSDPV1_RUN_TIME_LIMITS
    top_.access_interval_i = 48;
    top_.ready_cycles_i = 4096;
    top_.rts_lead_i = limits.rts_lead;
    top_.rts_trail_i = limits.rts_trail;
    top_.intr_low_i = top_.intr_gap_i = 64;
    top_.search_window_ms_i = limits.search_window_ms;
    top_.search_window_bits_i = 4000;
    top_.baud_control_ms_i = 600;
#endif
    top_.reset_i = 0;
    top_.pbrxd_i = 1;
    top_.csr_i = top_.rd_i = top_.wr_i = 1;
    top_.eval();  // so that the next one sees edges
    for (int i = 0; i < 4; ++i) step();
    settle_pins();
  }

  // One cycle: `edge` is the number of the last rising edge.
  void step() {
    top_.clk_i = 1;
    top_.eval();
    ++edge;
    see();
    receive();
    top_.clk_i = 0;
    top_.eval();
  }
  void step(int64_t cycles) {
    for (int64_t i = 0; i < cycles; ++i) step();
  }
  bool wait(const std::function<bool()>& until, int64_t limit) {
    for (int64_t i = 0; i < limit; ++i) {
      if (until()) return true;
      step();
    }
    return until();
  }

  void release_reset() { top_.reset_i = 1; }

  // ---- user port
  void own() {
    top_.r_req_i = 1;
    step(4);
    if (!wait([&] { return !top_.l_req_o && !top_.l_sta_o; }, 4000)) expect(0, 1, "the chip lets the user in");
    top_.r_sta_i = 1;
  }
  void disown() { top_.r_req_i = top_.r_sta_i = 0; }
  void write(int address, int value) {
    top_.csr_i = 0;
    top_.a_i = static_cast<uint16_t>(address);
    top_.d_i = static_cast<uint8_t>(value);
    top_.wr_i = 0;
    top_.eval();
    step();
    top_.wr_i = 1;
    top_.eval();
    step();
    top_.csr_i = 1;
  }
  int read(int address) {
    top_.csr_i = 0;
    top_.rd_i = 0;
    top_.a_i = static_cast<uint16_t>(address);
    top_.eval();
    step();
    expect(top_.d_oe_o, 1, "D is driven while RD is low");
    const int value = top_.d_o;
    top_.rd_i = top_.csr_i = 1;
    top_.eval();
    step();
    return value;
  }
  Bytes read(int address, int count) {
    Bytes bytes;
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<uint8_t>(read(address + i)));
    return bytes;
  }
  void write_block(int address, const Bytes& bytes, int crc_address, int flag) {
    for (size_t i = 0; i < bytes.size(); ++i) write(address + static_cast<int>(i), bytes[i]);
    write(crc_address, crc16(bytes) >> 8);
    write(crc_address + 1, crc16(bytes) & 0xFF);
    write(0x010, flag);
  }
  Bytes peek(int address, int count) {
    own();
    step(3);
    Bytes bytes = read(address, count);
    disown();
    return bytes;
  }

  // ---- bus
  void send(const Bytes& telegram) {
    step(40 * bit);
    send_at_once(telegram);
  }
  void send_at_once(const Bytes& telegram) {
    answer.clear();
    start_sampled = edge + 1;
    for (size_t n = 0; n < telegram.size(); ++n) {
      const uint8_t byte = telegram[n];
      int parity = static_cast<int>(n) == wrong_parity_at;
      put(0);
      for (int i = 0; i < 8; ++i) {
        put(byte >> i & 1);
        parity ^= byte >> i & 1;
      }
      put(parity);
      put(static_cast<int>(n) == no_stop_at ? 0 : 1);
      if (static_cast<int>(n) == no_stop_at) put(1);
      if (static_cast<int>(n) == gap_at) step(gap);
    }
    end = start_sampled + 2 + 11 * bit * static_cast<int64_t>(telegram.size());  // as the chip calculates it
  }
  Bytes ask(const Bytes& telegram, int tsdr = 11) {
    send(telegram);
    return finish(tsdr);
  }
  Bytes finish(int tsdr) {
    rts = Pin{};
    wait([&] { return rts.rise >= 0; }, 300 * bit);
    wait([&] { return rts.fall >= 0; }, 3000 * bit);
    const int64_t first = end - 2 + tsdr * bit;
    if (rts.rise >= 0) {
      expect(rts.rise, first - limits.rts_lead, "PBRTS rises ahead of the first start bit");
      expect(rts.fall, first + 11 * bit * static_cast<int64_t>(answer.size()) + limits.rts_trail,
             "PBRTS falls behind the answer");
    }
    return answer;
  }

  int64_t edge = -1;
  int bit = 4;
  int64_t start_sampled = 0, end = 0;
  int wrong_parity_at = -1, no_stop_at = -1, gap_at = -1;  // characters of the telegrams sent from now on
  int gap = 0;
  Pin rts, l_req, intr, br, pbf, ready;
  Bytes answer;
  uint64_t digest = 14695981039346656037U;  // of every level of the output pins (FNV-1a): equal runs have equal ones
  Vdsdpv1& pins() { return top_; }

 private:
  void put(int level) {
    top_.pbrxd_i = static_cast<uint8_t>(level);
    step(bit);
  }
  void settle_pins() {
    intr.level = 1;
    pbf.level = 1;
  }
  void see() {
    const int levels = top_.pbtxd_o | top_.pbrts_o << 1 | top_.l_req_o << 2 | top_.l_sta_o << 3 | top_.intr0_o << 4 |
                       top_.pbf_o << 5 | top_.br_o << 6 | top_.ready_o << 7;
    for (const int byte : {levels, top_.d_oe_o ? 0x100 | top_.d_o : 0})
      digest = (digest ^ static_cast<uint64_t>(byte)) * 1099511628211U;
    rts.see(top_.pbrts_o, edge);
    l_req.see(top_.l_req_o, edge);
    intr.see(top_.intr0_o, edge);
    br.see(top_.br_o, edge);
    pbf.see(top_.pbf_o, edge);
    ready.see(top_.ready_o, edge);
  }
  // The answer, sampled at mid-bit of PBTXD
  void receive() {
    if (rx_next_ < 0) {
      if (!top_.pbtxd_o) {
        rx_next_ = edge + bit + bit / 2;
        rx_bit_ = 0;
        rx_value_ = 0;
      }
      return;
    }
    if (edge != rx_next_) return;
    rx_next_ += bit;
    rx_value_ |= top_.pbtxd_o << rx_bit_++;
    if (rx_bit_ < 10) return;
    int ones = 0;
    for (int i = 0; i < 9; ++i) ones += rx_value_ >> i & 1;
    expect(ones % 2, 0, "even parity of the answer");
    expect(rx_value_ >> 9, 1, "stop bit of the answer");
    answer.push_back(static_cast<uint8_t>(rx_value_));
    rx_next_ = -1;
  }

  Vdsdpv1 top_;
  int64_t rx_next_ = -1;
  int rx_bit_ = 0;
  int rx_value_ = 0;
};

inline Bytes init_block(uint8_t prm_mode, uint8_t cfg_mode) {
  return {16, 5, 0x0C, 0xC9, 0x0F, 0, 0, 4, 4, 20, 20, prm_mode, 4, cfg_mode, 2, 0x13, 0x23};
}

// Who owns the DPRAM (ownership_test.cpp), on a chip in RESET
void ownership(Bench& b);

// What the user chooses with B005 and B011 (user_rules_test.cpp), on a chip in RESET
void user_rules(Bench& b);

// Repetitions, refusals, Not_Supported and high priority (service_rules_test.cpp), on a chip in RESET
void service_rules(Bench& b);

// The DPV1 part (dpv1_test.cpp), on a chip fresh out of RESET
void dpv1(Bench& b);

}  // namespace rtl

// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "rsu_bench.hpp"

namespace rtl {

RsuBench::RsuBench(const Chip& chip, bool starts) {
  top.fault_i = static_cast<uint8_t>(chip.fault);
  top.access_interval_i = 48;
  top.ready_cycles_i = 4096;
  top.rts_lead_i = top.rts_trail_i = 4;
  top.intr_low_i = top.intr_gap_i = 64;
  top.search_window_ms_i = 50;
  top.search_window_bits_i = 4000;
  top.baud_control_ms_i = 600;
  top.fcb_rule_i = 0;
  top.spi_reply_gap_i = chip.reply_gap;
  top.spi_write_gap_i = chip.write_gap;
  top.serial_block_crc_i = chip.block_crc;
  top.u_timer_i = chip.u_timer;
  top.uart_min_tsdr_i = chip.min_tsdr;
  top.uart_cfg_length_i = chip.cfg_length;
  for (size_t i = 0; i < 4; ++i) top.uart_gaps_i[i] = chip.gaps[2 * i] | chip.gaps[2 * i + 1] << 16;
  top.mode_i = static_cast<uint8_t>(chip.mode);
  top.adr_i = static_cast<uint8_t>(chip.adr);
  top.ubr_i = static_cast<uint8_t>(chip.ubr);
  top.uiv_i = static_cast<uint8_t>(chip.uiv);
  constexpr int64_t kBits[] = {5000, 2500, 1250, 833, 417, 208, 104, 26};
  bit = kBits[chip.ubr];
  top.reset_i = 0;
  top.pbrxd_i = top.csr_i = top.rd_i = top.wr_i = top.xss_i = top.rxd_i = 1;
  top.eval();
  txd.level = pbf.level = intr.level = 1;
  clock(8);
  if (starts) start_up();
}

void RsuBench::rise(int sck_level) {
  top.clk_i = 1;
  top.sck_i = static_cast<uint8_t>(sck_level);
  top.eval();
  ++edge;
  see();
  top.clk_i = 0;
  top.eval();
}

void RsuBench::clock(int64_t cycles) {
  for (int64_t i = 0; i < cycles; ++i) rise(top.sck_i);
  if (tick <= 250 * edge) tick = 250 * edge + 1;
}

void RsuBench::run_to(int64_t to) {
  while (250 * (edge + 1) < to) rise(top.sck_i);
  tick = to;
}

bool RsuBench::wait(const std::function<bool()>& until, int64_t limit) {
  for (int64_t i = 0; i < limit && !until(); ++i) clock();
  return until();
}

// RESET rises between edges 7 and 8
void RsuBench::start_up() {
  top.reset_i = 1;
  clock(2070);
}

void RsuBench::see() {
  see_miso(250 * edge);
  own.see(owns(), edge);
  host.see(host_owns(), edge);
  txd.see(top.txd_o, edge);
  ready.see(top.ready_o, edge);
  pbf.see(top.pbf_o, edge);
  intr.see(top.intr0_o, edge);
  if (top.rootp->dsdpv1_rsu__DOT__u_serial_port__DOT__u_telegram__DOT__judged_q) judged = edge + 1;
  if (owns() && host_owns()) expect(1, 0, "chip and host own the DPRAM at once");
}

void RsuBench::see_miso(int64_t at) {
  const int level = top.miso_oe_o ? top.miso_o : 2;
  if (miso.empty() || miso.back().level != level) miso.push_back({at, level});
}

int RsuBench::cell(int address) const {
  const auto row = static_cast<size_t>(address >> 2);
  switch (address & 3) {
    case 0: return top.rootp->dsdpv1_rsu__DOT__u_dpram__DOT__g_lane__BRA__0__KET____DOT__u_ram__DOT__memory_q[row];
    case 1: return top.rootp->dsdpv1_rsu__DOT__u_dpram__DOT__g_lane__BRA__1__KET____DOT__u_ram__DOT__memory_q[row];
    case 2: return top.rootp->dsdpv1_rsu__DOT__u_dpram__DOT__g_lane__BRA__2__KET____DOT__u_ram__DOT__memory_q[row];
    default: return top.rootp->dsdpv1_rsu__DOT__u_dpram__DOT__g_lane__BRA__3__KET____DOT__u_ram__DOT__memory_q[row];
  }
}

// ---- SPI. Equal ticks: CLK and SCK in one step, then all other inputs.

void RsuBench::xss(int64_t at, int level) {
  run_to(at + 1);
  tick = at;
  top.xss_i = static_cast<uint8_t>(level);
  top.eval();
  see_miso(at);
}

void RsuBench::sck(int64_t at, int level) {
  run_to(at);
  if (250 * (edge + 1) == at) {
    rise(level);
    return;
  }
  top.sck_i = static_cast<uint8_t>(level);
  top.eval();
  see_miso(at);
}

Bytes RsuBench::spi(const Bytes& request, size_t reply_bytes) {
  Bytes reply;
  const int64_t begin = tick + 1;
  int64_t at = begin + lead;
  xss(begin, 0);
  for (size_t i = 0; i < request.size() + reply_bytes; ++i) {
    const unsigned byte = i < request.size() ? request[i] : 0xA5;
    unsigned got = 0;
    for (int place = 7; place >= 0; --place) {
      top.mosi_i = static_cast<uint8_t>(byte >> place & 1);
      top.eval();
      run_to(at);
      got = got << 1 | top.miso_o;
      sck(at, 1);
      if (i + 1 == request.size() && place == 0) last_rise = at;
      sck(at + half, 0);
      at += 2 * half;
    }
    if (i >= request.size())
      reply.push_back(static_cast<uint8_t>(got));
    else
      expect(got, 0xFF, "MISO during the request");
  }
  xss(at - half + lag, 1);
  run_to(tick + high);
  return reply;
}

Bytes RsuBench::read(int address, size_t count) {
  const Bytes reply = spi(read_telegram(address, count), count + 4);
  Bytes data(reply.begin() + 2, reply.end() - 2);
  expect_bytes(reply, with_crc(Bytes{0x81, 0} + data), "form of a read's reply");
  return data;
}

void RsuBench::write(int address, const Bytes& data) {
  expect_bytes(spi(write_telegram(address, data), 4), {0xA1, 0x00, 0x20, 0x78}, "reply to a write");
}

bool RsuBench::claim() {
  for (int i = 0; i < 100; ++i)
    if (spi(write_telegram(0x014, {2}), 4) == Bytes{0xA1, 0x00, 0x20, 0x78}) return true;
  expect(0, 1, "the chip lets the host in");
  return false;
}

// ---- UART

void RsuBench::send_character(uint8_t byte) {
  const auto put = [&](int level) {
    top.rxd_i = static_cast<uint8_t>(level);
    clock(bit);
  };
  last_start = edge + 3;
  int parity = 0;
  put(0);
  for (int i = 0; i < 8; ++i) {
    put(byte >> i & 1);
    parity ^= byte >> i & 1;
  }
  put(parity);
  put(1);
}

void RsuBench::send(const Bytes& telegram) {
  for (size_t i = 0; i < telegram.size(); ++i) {
    const auto number = static_cast<int>(i);
    if (number == wrong_parity_at || number == no_stop_at) {
      const bool stop = number == no_stop_at;
      last_start = edge + 3;
      for (int k = 0; k < 11; ++k) {  // 00 with an odd parity bit, or with stop bit 0
        top.rxd_i = static_cast<uint8_t>(k == 9 ? !stop : k == 10 && !stop);
        clock(bit);
      }
      top.rxd_i = 1;
      if (stop) clock(bit);
      continue;
    }
    send_character(telegram[i]);
    if (number == pause_at) clock(pause);
  }
}

Bytes RsuBench::receive() {
  Bytes reply;
  txd.fall = -1;
  if (txd.level == 0 || wait([&] { return txd.fall >= 0; }, 300 * bit + 1000)) {
    reply_start = edge;
    for (bool more = true; more;) {
      int value = 0;
      clock(bit / 2);
      for (int i = 0; i < 11; ++i) {
        value |= top.txd_o << i;
        if (i < 10) clock(bit);
      }
      int ones = 0;
      for (int i = 1; i < 10; ++i) ones += value >> i & 1;
      expect((value & 1) | (ones & 1) << 1 | (value >> 10) << 2, 4, "start bit, parity and stop bit of the reply");
      reply.push_back(static_cast<uint8_t>(value >> 1));
      clock(bit - bit / 2);
      more = top.txd_o == 0;
    }
  }
  return reply;
}

Bytes RsuBench::ask(const Bytes& telegram) {
  send(telegram);
  return receive();
}

Bytes RsuBench::uart_read(int address, size_t count) {
  const Bytes reply = ask(read_telegram(address, count));
  if (reply.size() != count + 4) {
    expect_bytes(reply, Bytes(count + 4), "length of a read's reply");
    return Bytes(count);
  }
  Bytes data(reply.begin() + 2, reply.end() - 2);
  expect_bytes(reply, with_crc(Bytes{0x81, 0} + data), "form of a read's reply");
  return data;
}

void RsuBench::uart_write(int address, const Bytes& data) {
  expect_bytes(ask(write_telegram(address, data)), {0xA1, 0x00, 0x20, 0x78}, "reply to a write");
}

// ---- bus

void RsuBench::put_bus(int level) {
  top.pbrxd_i = static_cast<uint8_t>(level);
  clock(4);
}

void RsuBench::bus(const Bytes& telegram) {
  clock(200);
  for (const uint8_t byte : telegram) {
    int parity = 0;
    put_bus(0);
    for (int i = 0; i < 8; ++i) {
      put_bus(byte >> i & 1);
      parity ^= byte >> i & 1;
    }
    put_bus(parity);
    put_bus(1);
  }
  clock(2000);  // the answer goes by
}

// One byte of inputs, one of outputs; `write` is the host's
void RsuBench::to_data_exchange(const std::function<void(int, const Bytes&)>& write) {
  write(0x020, {16, 5, 0x0C, 0xC9, 0x0F, 0, 0, 4, 4, 20, 20, 0, 4, 1, 2, 0x10, 0x20});
  write(0x010, {4});
  clock(200);
  expect(top.ready_o, 1, "initialised without a block CRC");
  bus(sd1(9, 2, 0x49));
  bus(request(0x6D, 61, {0x88, 1, 1, 15, 0x0C, 0xC9, 1}));
  bus(request(0x4D, 62, {0x10, 0x20}));
  expect(top.pbf_o, 0, "DATA_EXCH");
}

}  // namespace rtl

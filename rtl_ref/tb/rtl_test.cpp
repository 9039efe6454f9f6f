// Test of the reference RTL by itself, under Verilator: what docs/microarchitecture.md says of pins and DPRAM, on the usual way from
// RESET to data exchange. The comparison with the model is not here but in the lockstep harness.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "Vdsdpv1.h"
#include "verilated.h"

namespace {

using Bytes = std::vector<uint8_t>;

// What the command line chooses: parameters of the chip, which without DSDPV1_RUN_TIME_LIMITS are those that run.sh builds it with
struct Limits {
  unsigned rts_lead = 4, rts_trail = 4, search_window_ms = 50;
} limits;

int failures = 0;

void expect(int64_t got, int64_t wanted, const char* what) {
  if (got == wanted) return;
  std::printf("FAILED %s: is %lld, not %lld\n", what, static_cast<long long>(got), static_cast<long long>(wanted));
  ++failures;
}

void expect_bytes(const Bytes& got, const Bytes& wanted, const char* what) {
  if (got == wanted) return;
  std::printf("FAILED %s: is", what);
  for (uint8_t byte : got) std::printf(" %02X", byte);
  std::printf(", not");
  for (uint8_t byte : wanted) std::printf(" %02X", byte);
  std::printf("\n");
  ++failures;
}

uint16_t crc16(const Bytes& bytes) {
  uint16_t crc = 0xFFFF;
  for (uint8_t byte : bytes) {
    crc = static_cast<uint16_t>(crc ^ byte);
    for (int i = 0; i < 8; ++i) crc = static_cast<uint16_t>(crc & 1 ? (crc >> 1) ^ 0xA001 : crc >> 1);
  }
  return crc;
}

// One pin's changes, by the number of the edge
struct Pin {
  int level = 0;
  int64_t rise = -1, fall = -1;
  void see(int now, int64_t edge) {
    if (now != level) (now ? rise : fall) = edge;
    level = now;
  }
};

class Bench {
 public:
  Bench() {
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
    const Bytes bytes = read(address, count);
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
      expect(rts.fall, first + 11 * bit * static_cast<int64_t>(answer.size()) + limits.rts_trail, "PBRTS falls behind the answer");
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

uint8_t sum(const Bytes& bytes) {
  unsigned total = 0;
  for (uint8_t byte : bytes) total += byte;
  return static_cast<uint8_t>(total);
}

Bytes sd1(uint8_t da, uint8_t sa, uint8_t fc) { return {0x10, da, sa, fc, sum({da, sa, fc}), 0x16}; }

Bytes sd2(const Bytes& body) {
  const auto le = static_cast<uint8_t>(body.size());
  Bytes telegram = {0x68, le, le, 0x68};
  telegram.insert(telegram.end(), body.begin(), body.end());
  telegram.push_back(sum(body));
  telegram.push_back(0x16);
  return telegram;
}

// A request to SAP dsap of station 5 from SAP 62 of master 2, and an answer of it
Bytes request(uint8_t fc, uint8_t dsap, const Bytes& data) {
  Bytes body = {0x85, 0x82, fc, dsap, 62};
  body.insert(body.end(), data.begin(), data.end());
  return sd2(body);
}
Bytes response(uint8_t fc, uint8_t dsap, const Bytes& data) {
  Bytes body = {0x82, 0x85, fc, 62, dsap};
  body.insert(body.end(), data.begin(), data.end());
  return sd2(body);
}

const Bytes kSc = {0xE5};

Bytes init_block(uint8_t prm_mode, uint8_t cfg_mode) {
  return {16, 5, 0x0C, 0xC9, 0x0F, 0, 0, 4, 4, 20, 20, prm_mode, 4, cfg_mode, 2, 0x13, 0x23};
}

// RESET, start-up and the first accesses (9.1, 9.7)
void start_up(Bench& b) {
  expect(b.pins().pbtxd_o && b.pins().intr0_o && b.pins().pbf_o, 1, "levels of reset that are high");
  expect(b.pins().pbrts_o || b.pins().l_req_o || b.pins().l_sta_o || b.pins().br_o || b.pins().ready_o, 0,
         "levels of reset that are low");
  b.pins().csr_i = b.pins().rd_i = 0;
  b.release_reset();
  const int64_t r = b.edge + 1 + 2;
  b.step(10);
  expect(b.pins().d_oe_o, 0, "RD low since before R is no access");
  b.pins().csr_i = b.pins().rd_i = 1;
  b.step();
  expect(b.l_req.rise, r, "start-up access begins at R");
  // A user who writes although the chip owns the DPRAM (P12): what is cleared already keeps his bytes
  b.step(r + 1500 - b.edge);
  for (int i = 0; i < 64; ++i) b.write(0x100 + i, i + 1);
  for (int i = 0; i < 16; ++i) b.write(0x7C0 + i, 0xFF);
  b.wait([&] { return b.l_req.fall >= 0; }, 3000);
  expect(b.l_req.fall, r + 2054, "start-up access ends");
  b.step(3);
  expect(b.l_req.rise, r + 2055, "first access behind start-up");
  b.wait([&] { return b.l_req.fall > b.l_req.rise; }, 100);
  expect(b.l_req.fall, r + 2055 + 8, "B012 is written in it");
  b.step(60);
  expect(b.l_req.rise, r + 2055 + 48, "access interval");
  expect(b.l_req.fall, r + 2055 + 48 + 7, "access with nothing due");
  const Bytes unowned = b.peek(0x100, 64);
  for (int i = 0; i < 64; ++i) expect(unowned[static_cast<size_t>(i)], i + 1, "write behind the clearing");
  expect_bytes(b.peek(0x7C0, 16), Bytes(16), "write ahead of the clearing");
  expect_bytes(b.peek(0x000, 8), {1, 0x0D, 7, 1, 0, 0, 1, 0}, "version");
  expect_bytes(b.peek(0x012, 1), {0xF0}, "B012 while searching");
  b.step(r + 4096 + 100 - b.edge);
  expect_bytes(b.peek(0x004, 1), {0xC5}, "B004");
}

void host_port(Bench& b) {
  b.own();
  for (int i = 0; i < 256; ++i) b.write(0x600 + i, i ^ 0x5A);
  b.step(3);
  for (int i = 0; i < 256; ++i) expect(b.read(0x600 + i), i ^ 0x5A, "what the user wrote");
  // a write settles at edge m+2; a read behind it sees it
  b.write(0x700, 0x99);
  b.step(2);
  expect(b.read(0x700), 0x99, "read behind a write");
  b.disown();
}

void initialise(Bench& b, uint8_t prm_mode, uint8_t cfg_mode) {
  Bytes block = init_block(prm_mode, cfg_mode);
  // first with a wrong CRC, then beyond a limit, then right
  b.own();
  b.write_block(0x020, block, 0x0F7, 0);
  b.write(0x0F8, 0x00);
  b.write(0x0F7, 0x00);
  b.write(0x010, 4);
  b.step(3);
  b.disown();
  b.step(200);
  expect_bytes(b.peek(0x00A, 2), {0, 1}, "wrong CRC of the initialisation");
  expect_bytes(b.peek(0x010, 1), {0}, "B010 behind it");
  block[1] = 127;
  b.own();
  b.write_block(0x020, block, 0x0F7, 4);
  b.step(3);
  b.disown();
  b.step(200);
  expect_bytes(b.peek(0x00A, 2), {0, 0}, "limits of the initialisation");
  expect_bytes(b.peek(0x013, 1), {1}, "B013");
  block[1] = 5;
  b.own();
  b.write_block(0x020, block, 0x0F7, 4);
  b.step(3);
  b.disown();
  b.step(2);
  b.wait([&] { return b.l_req.fall < b.l_req.rise; }, 100);
  const int64_t s = b.l_req.rise;
  b.step(100);
  expect(b.ready.rise, s + 7 + 1 + 16 + 4, "commit of the initialisation");
  expect_bytes(b.peek(0x00A, 2), {1, 0}, "initialised");
  expect_bytes(b.peek(0x012, 2), {0xF4, 0}, "B012, B013");
}

void baud(Bench& b, int rate_index) {
  static const int kBits[] = {4, 8, 16, 32};
  b.bit = kBits[rate_index];
  b.step(int64_t{rate_index} * limits.search_window_ms * 48000);
  b.send(sd1(9, 2, 0x49));
  b.step(4 * b.bit);
  expect(b.br.rise, b.end + b.bit + 1, "rate found at the decision");
  b.step(200);
  expect_bytes(b.peek(0x012, 1), {static_cast<uint8_t>(rate_index << 4 | 4)}, "B012 with the rate");
}

void fdl(Bench& b) {
  expect_bytes(b.ask(sd1(5, 2, 0x49)), sd1(2, 5, 0x00), "FDL status");
  expect_bytes(b.ask(sd1(6, 2, 0x49)), {}, "FDL status of another station");
  expect_bytes(b.ask(sd1(5, 2, 0x4E)), sd1(2, 5, 0x03), "Identify: RS");
  expect_bytes(b.ask(request(0x6D, 10, {})), sd1(2, 5, 0x03), "a SAP that does not exist: RS");
  Bytes wrong = sd1(5, 2, 0x49);
  wrong[4] ^= 1;
  expect_bytes(b.ask(wrong), {}, "wrong FCS");
}

// What makes a telegram void, to the cycle (section 7)
void receiver(Bench& b) {
  const Bytes status = sd1(5, 2, 0x49), answer = sd1(2, 5, 0);
  b.wrong_parity_at = 2;
  expect_bytes(b.ask(status), {}, "wrong parity");
  b.wrong_parity_at = -1;
  b.no_stop_at = 3;
  expect_bytes(b.ask(status), {}, "no stop bit");
  b.no_stop_at = -1;
  b.gap_at = 2;
  b.gap = b.bit;
  b.send(status);
  b.end += b.gap;
  expect_bytes(b.finish(11), answer, "a pause of one bit time is no gap");
  b.gap = b.bit + 1;
  expect_bytes(b.ask(status), {}, "a cycle more is one");
  b.gap_at = -1;
  Bytes longer = status;
  longer.push_back(0);
  expect_bytes(b.ask(longer), {}, "a character too many");
  for (const int idle : {33 * b.bit - 1, 33 * b.bit - 2}) {
    b.send(sd1(9, 2, 0x49));
    b.step(idle);
    b.send_at_once(status);
    expect_bytes(b.finish(11), idle == 33 * b.bit - 1 ? answer : Bytes{}, "T_SYN");
  }
  // glitches shorter than half a bit time do not end idle
  b.step(40 * b.bit);
  b.pins().pbrxd_i = 0;
  b.step(b.bit / 2 - 1);
  b.pins().pbrxd_i = 1;
  b.step(10);
  expect_bytes(b.ask(status), answer, "behind a glitch");
}

Bytes diag(uint8_t s1, uint8_t s2, uint8_t master) { return {s1, s2, 0, master, 0x0C, 0xC9}; }

void to_data_exchange(Bench& b) {
  expect_bytes(b.ask(request(0x6D, 60, {})), response(8, 60, diag(2, 5, 255)), "Slave_Diag in WAIT_PRM");
  const Bytes user_prm = {0, 0, 0, 0xAA, 0xBB};
  Bytes prm = {0xB8, 10, 10, 11, 0x0C, 0xC9, 1};
  prm.insert(prm.end(), user_prm.begin(), user_prm.end());
  expect_bytes(b.ask(request(0x5D, 61, prm)), kSc, "Set_Prm");
  b.step(200);
  Bytes block = {5, 0, 0, 0, 0xAA, 0xBB};
  expect_bytes(b.peek(0x410, 6), block, "parameters in the DPRAM");
  expect_bytes(b.peek(0x4FE, 2), {static_cast<uint8_t>(crc16(block) >> 8), static_cast<uint8_t>(crc16(block))}, "their CRC");
  expect_bytes(b.peek(0x00E, 1), {2}, "B00E.1");
  expect(b.intr.rise - b.intr.fall, 64, "INTR0 is low for 64 cycles");
  expect_bytes(b.ask(request(0x7D, 60, {})), response(8, 60, diag(2, 0x0C, 2)), "Slave_Diag in WAIT_CFG");
  expect_bytes(b.ask(request(0x5D, 62, {0x13, 0x23})), kSc, "Check_Cfg");
  expect(b.pbf.fall, b.end + b.bit + 1, "PBF falls at the decision");
  b.step(200);
  block = {4, 4, 2, 0x13, 0x23};
  expect_bytes(b.peek(0x500, 5), block, "configuration in the DPRAM");
  expect_bytes(b.peek(0x5CB, 2), {static_cast<uint8_t>(crc16(block) >> 8), static_cast<uint8_t>(crc16(block))}, "its CRC");
  expect_bytes(b.peek(0x00E, 1), {6}, "B00E.2");
  expect_bytes(b.ask(request(0x7D, 59, {})), response(8, 59, {0x13, 0x23}), "Get_Cfg");
}

void exchange(Bench& b) {
  expect_bytes(b.ask(sd2({5, 2, 0x5D, 1, 2, 3, 4})), sd2({2, 5, 8, 0, 0, 0, 0}), "first data exchange");
  b.step(200);
  expect_bytes(b.peek(0x319, 5), {4, 1, 2, 3, 4}, "outputs in the DPRAM");
  expect_bytes(b.peek(0x00E, 1), {7}, "B00E.0");
  b.own();
  b.write_block(0x130, {4, 9, 8, 7, 6}, 0x225, 1);
  b.step(3);
  b.disown();
  b.step(200);
  expect_bytes(b.ask(sd2({5, 2, 0x7D, 5, 6, 7, 8})), sd2({2, 5, 8, 9, 8, 7, 6}), "data exchange with inputs");
  b.own();
  b.write_block(0x130, {4, 0, 0, 0, 1}, 0x225, 1);
  b.step(3);
  b.disown();
  b.step(200);
  expect_bytes(b.ask(sd2({5, 2, 0x7D, 5, 6, 7, 8})), sd2({2, 5, 8, 9, 8, 7, 6}), "repetition");
  expect_bytes(b.ask(sd2({5, 2, 0x5D, 5, 6, 7, 8})), sd2({2, 5, 8, 0, 0, 0, 1}), "the next one");
  expect_bytes(b.ask(request(0x7D, 57, {})), response(8, 57, {5, 6, 7, 8}), "Read_Outputs");
}

void diagnosis(Bench& b) {
  b.own();
  b.write_block(0x227, {0x81, 3, 0x43, 0x11, 0x22}, 0x317, 2);
  b.step(3);
  b.disown();
  b.step(200);
  expect_bytes(b.ask(sd2({5, 2, 0x5D, 5, 6, 7, 8})), sd2({2, 5, 0x0A, 0, 0, 0, 1}), "high priority");
  expect_bytes(b.ask(request(0x7D, 57, {})), response(8, 57, {5, 6, 7, 8}), "only data exchange tells of high priority");
  Bytes data = diag(8, 0x0C, 2);
  data.insert(data.end(), {0x43, 0x11, 0x22});
  expect_bytes(b.ask(request(0x5D, 60, {})), response(8, 60, data), "diagnosis of the user");
  expect_bytes(b.ask(sd2({5, 2, 0x7D, 5, 6, 7, 8})), sd2({2, 5, 8, 0, 0, 0, 1}), "low priority behind it");
}

// Check_Cfg with the configuration in use is mail and nothing else (S16)
void check_again(Bench& b) {
  b.own();
  b.write(0x00E, 0);
  b.step(3);
  b.disown();
  expect_bytes(b.ask(request(0x5D, 62, {0x13, 0x23})), kSc, "Check_Cfg in DATA_EXCH");
  b.step(200);
  expect_bytes(b.peek(0x00E, 1), {4}, "B00E behind it: no outputs");
  expect_bytes(b.peek(0x500, 5), {4, 4, 2, 0x13, 0x23}, "configuration again in the DPRAM");
  expect_bytes(b.ask(request(0x7D, 57, {})), response(8, 57, {5, 6, 7, 8}), "the outputs stay");
}

// Frame count bit and SAP bytes (S20, S21)
void repetitions(Bench& b) {
  const Bytes outputs = request(0x5D, 57, {}), answer = response(8, 57, {5, 6, 7, 8});
  expect_bytes(b.ask(outputs), answer, "Read_Outputs ahead of an SDN");
  b.send(sd2({0x85, 0x82, 0x76, 40, 62, 0, 0}));
  b.step(20 * b.bit);
  b.ask(sd2({5, 2, 0x4D, 1, 2, 3, 4}));
  expect_bytes(b.ask(outputs), answer, "the memory stays behind an SDN and an answer that is not stored");
  expect_bytes(b.ask(sd2({5, 0x82, 0x4D, 62, 5, 6, 7, 8})), sd2({0x82, 5, 8, 62, 0, 0, 0, 1}), "SSAP alone");
  expect_bytes(b.ask(sd2({0x85, 2, 0x4D, 57})), sd2({2, 5, 8, 5, 6, 7, 8}), "DSAP alone");
}

void sync_and_freeze(Bench& b) {
  const auto command = [&](uint8_t code) {
    b.send(sd2({0xFF, 0x82, 0x46, 58, 62, code, 0}));
    b.step(20 * b.bit);
  };
  command(0x28);  // Sync, Freeze
  b.ask(sd2({5, 2, 0x7D, 0x21, 0x22, 0x23, 0x24}));
  b.own();
  b.write_block(0x130, {4, 0x31, 0x32, 0x33, 0x34}, 0x225, 1);
  b.step(3);
  b.disown();
  b.step(200);
  expect_bytes(b.peek(0x31A, 4), {5, 6, 7, 8}, "outputs held by sync");
  expect_bytes(b.ask(sd2({5, 2, 0x5D, 0x21, 0x22, 0x23, 0x25})), sd2({2, 5, 8, 0, 0, 0, 1}), "inputs held by freeze");
  command(0x28);
  b.step(200);
  expect_bytes(b.peek(0x31A, 4), {0x21, 0x22, 0x23, 0x25}, "outputs of the next Sync");
  expect_bytes(b.ask(sd2({5, 2, 0x7D, 0x21, 0x22, 0x23, 0x26})), sd2({2, 5, 8, 0x31, 0x32, 0x33, 0x34}), "next Freeze");
  command(0x14);  // Unsync, Unfreeze
  b.step(200);
  expect_bytes(b.peek(0x31A, 4), {0x21, 0x22, 0x23, 0x26}, "outputs of Unsync");
}

void leave(Bench& b) {
  expect_bytes(b.ask(sd2({5, 2, 0x5D, 1, 2, 3})), sd1(2, 5, 0x02), "wrong length: RR");
  expect(b.pbf.rise, b.end + b.bit + 1, "PBF rises at the decision");
  b.step(300);
  expect_bytes(b.peek(0x319, 5), {4, 0, 0, 0, 0}, "cleared outputs");
  expect_bytes(b.peek(0x008, 2), {0, 1}, "count of leaving");
  expect_bytes(b.ask(request(0x6D, 60, {})), response(8, 60, [] {
    Bytes data = diag(0x0E, 5, 255);
    data.insert(data.end(), {0x43, 0x11, 0x22});
    return data;
  }()), "Slave_Diag with Cfg_Fault");
}

// Two blocks in one access: the second pulse of INTR0 begins 64 cycles behind the first (section 13)
void interrupts(Bench& b) {
  b.own();
  b.ask(request(0x5D, 61, {0x88, 10, 10, 11, 0x0C, 0xC9, 1}));
  b.ask(request(0x7D, 62, {0x13, 0x23}));
  b.intr = Pin{};
  b.intr.level = 1;
  b.disown();
  b.wait([&] { return b.intr.rise >= 0; }, 300);
  const int64_t first = b.intr.rise;
  b.wait([&] { return b.intr.rise > first; }, 300);
  expect(b.intr.fall, first + 64, "gap between two pulses of INTR0");
  expect(b.intr.rise, first + 128, "second pulse of INTR0");
}

void user_judges(Bench& b) {
  b.own();
  b.write_block(0x020, init_block(2, 2), 0x0F7, 4);
  b.step(3);
  b.disown();
  b.step(200);
  b.send(sd1(9, 2, 0x49));
  b.step(200);
  b.own();
  b.write(0x00E, 0);
  b.disown();
  const auto accept = [&](int flag) {
    b.step(200);
    b.own();
    b.write(0x00C, 0);
    b.write(0x010, flag);
    b.step(3);
    b.disown();
    b.step(200);
  };
  expect_bytes(b.ask(request(0x6D, 61, {0x88, 1, 1, 15, 0x0C, 0xC9, 1})), kSc, "Set_Prm for the user");
  expect_bytes(b.ask(request(0x6D, 60, {})), response(8, 60, diag(2, 4, 255)), "Slave_Diag while the user judges");
  accept(0x80);
  expect_bytes(b.ask(request(0x4D, 62, {0x13, 0x23}), 15), kSc, "Check_Cfg for the user, new min_TSDR");
  accept(0x40);
  expect(b.pbf.level, 0, "the user's verdict leads to DATA_EXCH");
  expect_bytes(b.ask(sd2({5, 2, 0x5D, 1, 2, 3, 4}), 15), sd2({2, 5, 8, 0, 0, 0, 0}), "data exchange");
  // While the user judges a new Set_Prm, nothing of it is in force, and holder and watchdog stay (S15)
  expect_bytes(b.ask(request(0x4D, 61, {0x88, 2, 2, 20, 0x0C, 0xC9, 1}), 15), kSc, "Set_Prm again for the user");
  expect_bytes(b.ask(request(0x4D, 60, {}), 15), response(8, 60, diag(2, 0x0C, 2)), "holder and watchdog stay");
  expect_bytes(b.ask(sd2({0x85, 0x83, 0x4D, 61, 62, 0x88, 2, 2, 20, 0x0C, 0xC9, 1}), 15), sd1(3, 5, 3), "another master");
  accept(0x80);
  // A configuration without inputs (S19, S20)
  expect_bytes(b.ask(request(0x4D, 62, {0x23}), 20), kSc, "Check_Cfg without inputs");
  accept(0x40);
  b.own();
  b.write_block(0x227, {0x81, 0}, 0x317, 2);
  b.step(3);
  b.disown();
  b.step(200);
  expect_bytes(b.ask(request(0x4D, 56, {}), 20), kSc, "Read_Inputs without inputs");
  expect_bytes(b.ask(sd2({5, 2, 0x4D, 1, 2, 3, 4}), 20), sd1(2, 5, 0x0A), "high priority without inputs");
  b.ask(request(0x4D, 60, {}), 20);
  expect_bytes(b.ask(sd2({5, 2, 0x4D, 1, 2, 3, 4}), 20), kSc, "data exchange without inputs");
  b.pbf.rise = -1;
  const int64_t triggered = b.end + b.bit + 1;
  b.step(2000000);
  expect(b.pbf.rise, triggered + 1920000, "watchdog of 40 ms");
}

}  // namespace

// rtl_test [NAME=NUMBER...]: names of Limits, or fault, and with that only the faster part, for the build with faults
int main(int argc, char** argv) {
  Verilated::commandArgs(argc, argv);
  unsigned fault = 0;
  const std::map<std::string, unsigned*> settings = {{"rts_lead", &limits.rts_lead},
                                                     {"rts_trail", &limits.rts_trail},
                                                     {"search_window_ms", &limits.search_window_ms},
                                                     {"fault", &fault}};
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const size_t equals = argument.find('=');
    const auto setting = settings.find(argument.substr(0, equals));
    if (setting == settings.end() || equals == std::string::npos) {
      std::fprintf(stderr, "rtl_test: unknown argument %s, allowed are rts_lead, rts_trail, search_window_ms, fault =NUMBER\n", argv[i]);
      return 2;
    }
    *setting->second = static_cast<unsigned>(std::stoul(argument.substr(equals + 1)));
  }
  const uint16_t example = crc16({2, 7});
  expect(example, 0x1241, "CRC of 02 07");
  for (int rate : {0, 3}) {
    if (fault != 0 && rate != 0) break;
    Bench b;
#ifdef DSDPV1_FAULTS
    b.pins().fault_i = static_cast<uint8_t>(fault);
#endif
    start_up(b);
    host_port(b);
    initialise(b, 0, 1);
    baud(b, rate);
    fdl(b);
    receiver(b);
    to_data_exchange(b);
    exchange(b);
    diagnosis(b);
    check_again(b);
    repetitions(b);
    sync_and_freeze(b);
    leave(b);
    interrupts(b);
    if (rate == 0) user_judges(b);
    std::printf("rate index %d: %lld cycles, pins %016llx\n", rate, static_cast<long long>(b.edge),
                static_cast<unsigned long long>(b.digest));
  }
  std::printf("%d failures\n", failures);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Test of the reference RTL by itself, under Verilator: what docs/microarchitecture.md says of pins and DPRAM, on the
// usual way from RESET to data exchange. The comparison with the model is not here but in the lockstep harness.
#include <cstdlib>
#include <map>

#include "rtl_bench.hpp"

namespace rtl {
namespace {

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
  // A user who writes although the chip owns the DPRAM (P12): what is cleared already keeps the user's bytes
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
  static constexpr int kBits[] = {4, 8, 16, 32};
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
  expect_bytes(b.peek(0x4FE, 2), {static_cast<uint8_t>(crc16(block) >> 8), static_cast<uint8_t>(crc16(block))},
               "their CRC");
  expect_bytes(b.peek(0x00E, 1), {2}, "B00E.1");
  expect(b.intr.rise - b.intr.fall, 64, "INTR0 is low for 64 cycles");
  expect_bytes(b.ask(request(0x7D, 60, {})), response(8, 60, diag(2, 0x0C, 2)), "Slave_Diag in WAIT_CFG");
  expect_bytes(b.ask(request(0x5D, 62, {0x13, 0x23})), kSc, "Check_Cfg");
  expect(b.pbf.fall, b.end + b.bit + 1, "PBF falls at the decision");
  b.step(200);
  block = {4, 4, 2, 0x13, 0x23};
  expect_bytes(b.peek(0x500, 5), block, "configuration in the DPRAM");
  expect_bytes(b.peek(0x5CB, 2), {static_cast<uint8_t>(crc16(block) >> 8), static_cast<uint8_t>(crc16(block))},
               "its CRC");
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
  expect_bytes(b.ask(request(0x7D, 57, {})), response(8, 57, {5, 6, 7, 8}),
               "only data exchange tells of high priority");
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

// SAP bytes (S21)
void sap_bytes(Bench& b) {
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
  expect_bytes(b.ask(request(0x6D, 60, {})),
               response(8, 60,
                        [] {
                          Bytes data = diag(0x0E, 5, 255);
                          data.insert(data.end(), {0x43, 0x11, 0x22});
                          return data;
                        }()),
               "Slave_Diag with Cfg_Fault");
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
  expect_bytes(b.ask(sd2({0x85, 0x83, 0x4D, 61, 62, 0x88, 2, 2, 20, 0x0C, 0xC9, 1}), 15), sd1(3, 5, 3),
               "another master");
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

void usual_way(Bench& b, int rate) {
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
  sap_bytes(b);
  sync_and_freeze(b);
  leave(b);
  interrupts(b);
}

struct Choice {
  unsigned fault = 0, with_dpv1 = 1;
};

bool read(int argc, char** argv, Choice& choice) {
  const std::map<std::string, unsigned*> settings = {{"rts_lead", &limits.rts_lead},
                                                     {"rts_trail", &limits.rts_trail},
                                                     {"search_window_ms", &limits.search_window_ms},
                                                     {"fault", &choice.fault},
                                                     {"dpv1", &choice.with_dpv1}};
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const size_t equals = argument.find('=');
    const auto setting = settings.find(argument.substr(0, equals));
    char* end = nullptr;
    const char* const number = argv[i] + (equals == std::string::npos ? argument.size() : equals + 1);
    const unsigned long value = std::strtoul(number, &end, 10);
    if (setting == settings.end() || *number == 0 || *end != 0) {
      std::fprintf(
          stderr,
          "rtl_test: unknown argument %s, allowed are rts_lead, rts_trail, search_window_ms, fault, dpv1 =NUMBER\n",
          argv[i]);
      return false;
    }
    *setting->second = static_cast<unsigned>(value);
  }
  return true;
}

// One chip's part of the test
template <class Part>
void play(const char* name, unsigned fault, const Part& part) {
  Bench b(fault);
  part(b);
  std::printf("%s: %lld cycles, pins %016llx\n", name, static_cast<long long>(b.edge),
              static_cast<unsigned long long>(b.digest));
}

}  // namespace

int test(int argc, char** argv) {
  Choice choice;
  if (!read(argc, argv, choice)) return 2;
  const unsigned fault = choice.fault;
  const uint16_t example = crc16({2, 7});
  expect(example, 0x1241, "CRC of 02 07");
  play("rate index 0", fault, [](Bench& b) { usual_way(b, 0), user_judges(b); });
  if (fault == 0) play("rate index 3", fault, [](Bench& b) { usual_way(b, 3); });
  play("ownership", fault, ownership);
  play("rules of the user", fault, user_rules);
  play("rules of services", fault, service_rules);
  if (choice.with_dpv1 != 0) play("DPV1", fault, dpv1);
  std::printf("%d failures\n", failures);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace rtl

// rtl_test [NAME=NUMBER...]: names of Limits, or fault, and with that only the faster part, for the build with faults
int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape): of Failure, without looks_for_fault
  Verilated::commandArgs(argc, argv);
  return rtl::test(argc, argv);
}

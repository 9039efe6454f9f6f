// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Rules of telegrams and services: SA 127 (S32), address 126 (S33), repetitions (S26), Unlock (S28), data bytes where
// there are to be none (S13), Not_Supported by Global_Control (S24) and high priority (D9).
#include "rtl_bench.hpp"

namespace rtl {
namespace {

constexpr uint8_t kRs = 3, kRr = 2;

void give(Bench& b, int address, const Bytes& block, int crc_address, int flag) {
  b.own();
  b.write_block(address, block, crc_address, flag);
  b.step(3);
  b.disown();
  b.step(200);
}

void initialise(Bench& b, uint8_t address, uint8_t command) {
  Bytes block = init_block(0, 1);
  block[1] = address;
  block[4] = command;
  give(b, 0x020, block, 0x0F7, 4);
}

Bytes set_prm(uint8_t fc, uint8_t status, uint8_t flags, uint8_t group = 1) {
  return request(fc, 61, {status, 10, 10, 11, 0x0C, 0xC9, group, flags});
}

void to_data_exchange(Bench& b, uint8_t status) {
  expect_bytes(b.ask(set_prm(0x4D, status, 0)), kSc, "Set_Prm");
  expect_bytes(b.ask(request(0x4D, 62, {0x13, 0x23})), kSc, "Check_Cfg");
  expect(b.pbf.level, 0, "DATA_EXCH");
}

int diag_byte(Bench& b, size_t n) {
  const Bytes answer = b.ask(request(0x4D, 60, {}));
  return answer.size() > 9 + n ? answer[9 + n] : -1;
}

// A slave at 126 waits for an address (S33); SA 127 is nobody's (S32)
void addresses(Bench& b) {
  initialise(b, 126, 1);
  b.ask(sd1(9, 127, 0x49));
  expect(b.br.level, 1, "a telegram of SA 127 locks the rate");
  const auto to_126 = [](uint8_t dsap, const Bytes& data) {
    Bytes body = {0xFE, 0x82, 0x4D, dsap, 62};
    body.insert(body.end(), data.begin(), data.end());
    return sd2(body);
  };
  const Bytes refused = sd1(2, 126, kRs);
  expect_bytes(b.ask(to_126(61, {0x88, 10, 10, 11, 0x0C, 0xC9, 1})), refused, "Set_Prm at address 126");
  expect_bytes(b.ask(sd1(126, 127, 0x49)), {}, "FDL status of SA 127");
  expect_bytes(b.ask(to_126(55, {5, 0x0C, 0xC9, 0})), kSc, "Set_Slave_Address");
  to_data_exchange(b, 0x80);
}

Bytes exchange(uint8_t fc, uint8_t last = 4, uint8_t sa = 2) { return sd2({5, sa, fc, 1, 2, 3, last}); }
Bytes with_inputs(uint8_t value) { return sd2({2, 5, 8, value, 0, 0, 0}); }

void give_inputs(Bench& b, uint8_t value) { give(b, 0x130, {4, value, 0, 0, 0}, 0x225, 1); }

// Whether a data exchange behind the telegram is the repetition of the one ahead of it: the inputs change in between
void expect_memory(Bench& b, const Bytes& between, bool kept, const char* what) {
  give_inputs(b, 0x10);
  expect_bytes(b.ask(exchange(0x7D)), with_inputs(0x10), "a data exchange to be repeated");
  give_inputs(b, 0x20);
  if (!between.empty()) b.ask(between);
  expect_bytes(b.ask(exchange(0x7D)), with_inputs(kept ? 0x10 : 0x20), what);
  b.ask(sd1(5, 2, 0x49));
}

// What keeps the memory of the last answer and what ends it (S26)
void repetitions(Bench& b) {
  expect_memory(b, {}, true, "the repetition");
  expect_memory(b, sd2({0xFF, 0x82, 0x46, 58, 62, 0, 0}), true, "behind a broadcast");
  expect_memory(b, sd2({0x85, 0x82, 0x76, 40, 62, 0, 0}), true, "behind an SDN");
  expect_memory(b, sd1(9, 2, 0x79), true, "behind a telegram to another station");
  expect_memory(b, sd1(5, 127, 0x7C), true, "behind one of SA 127");
  expect_memory(b, sd1(5, 3, 0x49), false, "behind FDL status");
  expect_memory(b, sd1(5, 2, 0x7E), false, "behind a refused request");
  expect_memory(b, exchange(0x5D), false, "behind the other FCB");
  expect_memory(b, exchange(0x4D), false, "behind one without FCV");
  expect_bytes(b.ask(sd1(5, 2, 0x69)), sd1(2, 5, 0), "first request of a series");
  give_inputs(b, 0x30);
  b.ask(exchange(0x6D));
  give_inputs(b, 0x40);
  expect_bytes(b.ask(exchange(0x7D)), with_inputs(0x40), "the first one of a series is not remembered");
}

// A request that is not the last one again in all that counts, although its FCS is the same (S26)
void not_repeated(Bench& b) {
  const auto after = [&](const Bytes& first, const Bytes& other, const Bytes& wanted, const char* what) {
    b.ask(sd1(5, 2, 0x49));
    b.ask(first);
    expect_bytes(b.ask(other), wanted, what);
  };
  give_inputs(b, 0x10);
  after(exchange(0x7D), sd2({5, 3, 0x7D, 1, 2, 3, 3}), sd1(3, 5, kRs), "another SA");
  after(exchange(0x7C, 4), exchange(0x7D, 3), with_inputs(0x10), "another FC");
  b.step(200);
  expect_bytes(b.peek(0x31D, 1), {3}, "it is executed");
  after(request(0x7D, 57, {1}), request(0x7D, 58, {0}), sd1(2, 5, kRs), "another DSAP");
  after(sd2({5, 0x82, 0x7D, 62, 1, 2, 3, 4}), sd2({5, 0x82, 0x7D, 61, 1, 2, 3, 5}),
        sd2({0x82, 5, 8, 61, 0x10, 0, 0, 0}), "another SSAP");
  after(sd2({0x85, 2, 0x7D, 60}), sd2({0x85, 2, 0x7D, 60, 0}), sd1(2, 5, kRr), "another length");
  after(exchange(0x7D, 4), exchange(0x7D, 9), with_inputs(0x10), "another FCS");
  b.step(200);
  expect_bytes(b.peek(0x31D, 1), {9}, "it is executed");
}

// Requests that are to carry no data (S13)
void data_bytes(Bench& b) {
  for (const uint8_t dsap : {56, 57, 59, 60})
    expect_bytes(b.ask(request(0x4D, dsap, {0})), sd1(2, 5, kRr), "data bytes where there are to be none");
}

// High priority while a static diagnosis stands (D9)
void static_diagnosis(Bench& b) {
  const auto priority = [&] {
    const Bytes answer = b.ask(sd2({5, 2, 0x4D, 1, 2, 3, 4}));
    return answer.size() > 6 ? answer[6] : -1;
  };
  give(b, 0x227, {0x82, 0}, 0x317, 2);
  diag_byte(b, 0);
  expect(priority(), 0x0A, "static diagnosis, read");
  give(b, 0x227, {0x00, 0}, 0x317, 2);
  diag_byte(b, 0);
  expect(priority(), 0x0A, "behind a block of type 00");
  give(b, 0x227, {0x02, 0}, 0x317, 2);
  expect(priority(), 0x0A, "static diagnosis gone, not yet read");
  diag_byte(b, 0);
  expect(priority(), 8, "read");
}

// Sync and Freeze that the user has not set (S24)
void not_supported(Bench& b) {
  const auto after = [&](uint8_t command) {
    to_data_exchange(b, 0x80);
    b.send(sd2({0xFF, 0x82, 0x46, 58, 62, command, 0}));
    b.step(20 * b.bit);
    return diag_byte(b, 0) & 0x10;
  };
  for (const uint8_t command : {0x20, 0x08, 0x22}) expect(after(command), 0x10, "Not_Supported behind Sync or Freeze");
  for (const uint8_t command : {0x02, 0x30, 0x0C, 0x14})
    expect(after(command), 0, "overruled, or an end, or Clear_Data");
}

// Unlock with a wrong ident number is a fault (S28)
void unlock(Bench& b) {
  b.ask(request(0x4D, 61, {0x40, 0, 0, 0, 0x0C, 0xC8, 0}));
  expect(diag_byte(b, 0) & 0x40, 0x40, "Unlock with another ident number");
  to_data_exchange(b, 0x80);
  b.ask(request(0x4D, 61, {0xC0, 0, 0, 0, 0x0C, 0xC9, 0}));
  expect(b.pbf.level, 1, "Unlock");
  expect(diag_byte(b, 0) & 0x40, 0, "it is no fault");
}

}  // namespace

void service_rules(Bench& b) {
  b.release_reset();
  b.step(5000);
  addresses(b);
  repetitions(b);
  not_repeated(b);
  data_bytes(b);
  static_diagnosis(b);
  not_supported(b);
  unlock(b);
}

}  // namespace rtl

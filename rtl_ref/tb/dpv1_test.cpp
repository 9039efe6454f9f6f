// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// The DPV1 part of the RTL's own test (section 15; V1 to V15): what C1 and C2 answer, what the user finds in the DPRAM,
// and the cycles of turn and timers. At 12 Mbit/s: a decision falls 5 cycles behind the calculated end of the telegram.
#include <utility>

#include "rtl_bench.hpp"

namespace rtl {
namespace {

constexpr uint8_t kRs = 3, kRr = 2;
constexpr int64_t kUnit = 480000;  // cycles of 10 ms
constexpr int kC1 = 0x5D0, kC2 = 0x6D0;

struct Path {
  uint8_t master, dsap, ssap;
};
constexpr Path kClass1{2, 51, 51}, kInitiate{2, 49, 50}, kFirst{2, 48, 50}, kSecond{3, 47, 50};

Bytes telegram(const Path& path, uint8_t fc, const Bytes& data) {
  Bytes body = {0x85, static_cast<uint8_t>(0x80 | path.master), fc, path.dsap, path.ssap};
  body.insert(body.end(), data.begin(), data.end());
  return sd2(body);
}
Bytes srd(const Path& path, const Bytes& data = {}) { return telegram(path, 0x4D, data); }
Bytes answer(const Path& path, const Bytes& data) {
  Bytes body = {static_cast<uint8_t>(0x80 | path.master), 0x85, 8, path.ssap, path.dsap};
  body.insert(body.end(), data.begin(), data.end());
  return sd2(body);
}
Bytes refusal(const Path& path, uint8_t fc) { return sd1(path.master, 5, fc); }

int64_t decided(const Bench& b) { return b.end + b.bit + 1; }

// Sends the telegram so that it is decided at the cycle, and reads the answer
Bytes ask_at(Bench& b, const Bytes& bytes, int64_t cycle) {
  const int64_t start = cycle - 3 - b.bit - 11 * b.bit * static_cast<int64_t>(bytes.size());
  expect(start > b.edge + 40 * b.bit, 1, "there is time until the telegram");
  b.step(start - 1 - b.edge);
  b.send_at_once(bytes);
  expect(decided(b), cycle, "the telegram is decided when it should");
  return b.finish(11);
}

// The user writes a block for B011 and lets the chip in; the start of the access that takes it
int64_t give(Bench& b, int area, const Bytes& bytes, uint16_t crc_change = 0) {
  b.own();
  for (size_t i = 0; i < bytes.size(); ++i) b.write(area + static_cast<int>(i), bytes[i]);
  const auto crc = static_cast<uint16_t>(crc16(bytes) ^ crc_change);
  b.write(area + 244, crc >> 8);
  b.write(area + 245, crc & 0xFF);
  b.write(0x011, area == kC1 ? 1 : 2);
  b.step(3);
  b.disown();
  const int64_t before = b.l_req.rise;
  b.wait([&] { return b.l_req.rise > before; }, 100);
  const int64_t s = b.l_req.rise;
  b.wait([&] { return b.l_req.fall > s; }, 600);
  return s;
}

// What the chip has written for the user, and its flag, which the user takes back
void expect_request(Bench& b, int area, const Bytes& bytes, const char* what) {
  b.step(100 + static_cast<int64_t>(bytes.size()));
  const uint16_t crc = crc16(bytes);
  expect_bytes(b.peek(area, static_cast<int>(bytes.size())), bytes, what);
  expect_bytes(b.peek(area + 244, 2), {static_cast<uint8_t>(crc >> 8), static_cast<uint8_t>(crc)}, "its CRC");
  expect_bytes(b.peek(0x00F, 1), {static_cast<uint8_t>(area == kC1 ? 1 : 2)}, "its flag in B00F");
  b.own();
  b.write(0x00F, 0);
  b.step(3);
  b.disown();
  b.step(60);
}
void expect_no_request(Bench& b, const char* what) {
  b.step(200);
  expect_bytes(b.peek(0x00F, 1), {0}, what);
}

void initialise(Bench& b, uint8_t dpv1_enable) {
  b.own();
  b.write(0x005, dpv1_enable);
  b.write_block(0x020, init_block(0, 1), 0x0F7, 4);
  b.step(3);
  b.disown();
  b.step(200);
  b.send(sd1(9, 2, 0x49));
  b.step(40);
}

void to_data_exchange(Bench& b, uint8_t dpv1_status) {
  b.ask(request(0x4D, 61, {0x80, 1, 1, 11, 0x0C, 0xC9, 0, dpv1_status, 0, 0}));
  b.step(300);
  b.pbf.fall = -1;
  b.ask(request(0x4D, 62, {0x13, 0x23}));
  b.step(300);
  expect(b.pbf.level, 0, "DATA_EXCH");
}

// Master and set-up that C1 asks for (V1, V7)
void c1_refusals(Bench& b) {
  expect_bytes(b.ask(srd(kClass1)), refusal(kClass1, kRs), "C1 outside DATA_EXCH");
  expect_bytes(b.ask(srd(kInitiate)), refusal(kInitiate, kRs), "Initiate without 1D in B005");
  initialise(b, 0x1D);
  to_data_exchange(b, 0x00);
  expect_bytes(b.ask(srd(kClass1)), refusal(kClass1, kRs), "C1 without DPV1_Enable");
  to_data_exchange(b, 0x80);
  expect_bytes(b.ask(srd(kClass1)), kSc, "C1: nothing waits");
  expect_bytes(b.ask(srd({2, 51, 50})), refusal(kClass1, kRs), "C1 from another SSAP");
  expect_bytes(b.ask(sd2({0x85, 2, 0x4D, 51})), refusal(kClass1, kRs), "C1 without SSAP");
  expect_bytes(b.ask(srd({3, 51, 51})), refusal({3, 51, 51}, kRs), "C1 of another master");
  expect_bytes(b.ask(srd({2, 50, 51})), refusal(kClass1, kRs), "SAP 50");
}

void c1_read(Bench& b) {
  const Bytes read = {0x5E, 1, 2, 0x10};
  b.own();
  expect_bytes(b.ask(srd(kClass1, read)), kSc, "C1 read");
  b.disown();
  const int64_t before = b.l_req.rise;
  b.wait([&] { return b.l_req.rise > before; }, 100);
  const int64_t taken = b.l_req.rise;
  b.wait([&] { return b.l_req.fall > taken; }, 100);
  expect(b.l_req.fall, taken + 7 + 4 + 3, "access with a C1 request of 4 bytes");
  expect_request(b, kC1, read, "C1 read in the DPRAM");
  expect_bytes(b.ask(srd(kClass1)), kSc, "poll while it is open");
  expect_bytes(b.ask(srd(kClass1, read)), refusal(kClass1, kRr), "a second request");

  Bytes good = read;
  for (uint8_t i = 0; i < 16; ++i) good.push_back(static_cast<uint8_t>(0x40 + i));
  const int64_t s = give(b, kC1, good, 0x0001);
  expect(b.l_req.fall, s + 7 + 4 + 16 + 4 + 1 + 2, "access with a C1 answer of 16 bytes and B00B");
  expect_bytes(b.peek(0x00B, 1), {0x10}, "wrong CRC of the C1 answer");
  expect_bytes(b.peek(0x011, 1), {0}, "B011 behind it");
  Bytes other = good;
  other[2] = 3;
  give(b, kC1, other);
  expect_bytes(b.peek(0x00B, 1), {0}, "right CRC of a C1 answer");
  other[2] = 2;
  other[1] = 3;
  give(b, kC1, other);
  give(b, kC1, {0x5F, 1, 2, 0x10});
  give(b, kC1, {0x5E, 1, 2, 241});
  expect_bytes(b.ask(srd(kClass1)), kSc, "refused answers leave the request open");
  give(b, kC1, good);
  give(b, kC1, {0x5E, 1, 2, 1, 0xEE});
  expect_bytes(b.ask(srd(kClass1, read)), refusal(kClass1, kRr), "a request while the answer waits");
  expect_bytes(b.ask(srd(kClass1)), answer(kClass1, good), "C1 read answer");
  expect_bytes(b.ask(srd(kClass1)), kSc, "nothing waits behind it");
}

void c1_write_and_errors(Bench& b) {
  const Bytes write = {0x5F, 4, 5, 3, 0xA, 0xB, 0xC};
  expect_bytes(b.ask(srd(kClass1, write)), kSc, "C1 write");
  expect_request(b, kC1, write, "C1 write in the DPRAM");
  give(b, kC1, {0x5F, 4, 5, 3});
  expect_bytes(b.ask(srd(kClass1)), answer(kClass1, {0x5F, 4, 5, 3}), "C1 write answer");
  b.ask(srd(kClass1, write));
  b.step(200);
  give(b, kC1, {0xDF, 0x80, 0xB2, 9});
  expect_bytes(b.ask(srd(kClass1)), answer(kClass1, {0xDF, 0x80, 0xB2, 9}), "C1 error of the user");
  b.own();
  b.write(0x00F, 0);
  b.step(3);
  b.disown();
  const std::vector<std::pair<Bytes, Bytes>> wrong = {
      {{0x51, 1, 2, 0}, {0xD1, 0x80, 0xA9, 0}}, {{0x48}, {0xC8, 0x80, 0xA9, 0}},
      {{0x5E, 1, 2}, {0xDE, 0x80, 0xB8, 0}},    {{0x5E, 1, 2, 1, 0}, {0xDE, 0x80, 0xB8, 0}},
      {{0x5F, 1, 2, 1}, {0xDF, 0x80, 0xB1, 0}}, {{0x5F, 1, 2, 1, 0, 0}, {0xDF, 0x80, 0xB1, 0}},
      {{0x5F, 1, 2}, {0xDF, 0x80, 0xB1, 0}},    {{0x5E}, {0xDE, 0x80, 0xB8, 0}},
      {{0x5F}, {0xDF, 0x80, 0xB1, 0}}};
  for (const auto& [pdu, negative] : wrong) {
    expect_bytes(b.ask(srd(kClass1, pdu)), kSc, "a wrong request is acknowledged");
    expect_bytes(b.ask(srd(kClass1)), answer(kClass1, negative), "and answered by the chip");
  }
  expect_no_request(b, "the user sees no wrong request");
}

void longest(Bench& b) {
  Bytes write = {0x5F, 7, 8, 240};
  for (int i = 0; i < 240; ++i) write.push_back(static_cast<uint8_t>(i * 7));
  expect_bytes(b.ask(srd(kClass1, write)), kSc, "C1 write of 240 bytes");
  expect_request(b, kC1, write, "240 bytes in the DPRAM");
  give(b, kC1, {0x5F, 7, 8, 240});
  b.ask(srd(kClass1));
  expect_bytes(b.ask(srd(kClass1, {0x5E, 7, 8, 250})), kSc, "C1 read of 250 bytes");
  expect_request(b, kC1, {0x5E, 7, 8, 250}, "it is the user's to judge");
  write[0] = 0x5E;
  give(b, kC1, write);
  expect_bytes(b.ask(srd(kClass1)), answer(kClass1, write), "C1 answer of 240 bytes");
  b.own();
  b.write(0x00F, 0);
  b.step(3);
  b.disown();
}

// Leaving DATA_EXCH: what is not yet in the DPRAM is not written, what is there is not answered
void c1_left(Bench& b) {
  b.own();
  b.ask(srd(kClass1, {0x5E, 1, 1, 1}));
  b.ask(sd2({5, 2, 0x4D, 1, 2, 3}));
  b.disown();
  expect_no_request(b, "a withdrawn C1 request");
  to_data_exchange(b, 0x80);
  expect_bytes(b.ask(srd(kClass1, {0x5E, 1, 1, 1})), kSc, "a new request behind it");
  expect_request(b, kC1, {0x5E, 1, 1, 1}, "the new request in the DPRAM");
  b.ask(sd2({5, 2, 0x4D, 1, 2, 3}));
  to_data_exchange(b, 0x80);
  give(b, kC1, {0x5E, 1, 1, 1, 0x77});
  expect_bytes(b.ask(srd(kClass1)), kSc, "an answer to a withdrawn request");
}

Bytes initiate(uint16_t timeout, const Bytes& address, uint8_t features = 1) {
  Bytes pdu = {0x57, 0, 0, 0, static_cast<uint8_t>(timeout >> 8), static_cast<uint8_t>(timeout), features, 0,
               0,    0, 0, 0};
  pdu.insert(pdu.end(), address.begin(), address.end());
  return pdu;
}

// Initiate and its poll: the channel is OPEN; the cycle of the poll's decision, from which I runs
int64_t connect(Bench& b, const Path& channel, uint16_t timeout) {
  const Path first{channel.master, 49, 50};
  const auto high = static_cast<uint8_t>(timeout >> 8), low = static_cast<uint8_t>(timeout);
  expect_bytes(b.ask(srd(first, initiate(timeout, {1, 2}))), answer(first, {0x56, channel.dsap, high, low}),
               "Initiate");
  expect_bytes(b.ask(srd(channel)), answer(channel, {0x57, 0xF0, 1, 0, 0, 0, 0, 0, 2, 1}), "its poll, short Add_Addr");
  return decided(b);
}
void abort(Bench& b, const Path& channel) {
  expect_bytes(b.ask(srd(channel, {0x58, 0, 0, 0})), kSc, "abort of the master");
}

void c2_initiate(Bench& b) {
  expect_bytes(b.ask(srd({2, 49, 51}, initiate(1, {0, 0}))), refusal(kInitiate, kRs), "Initiate from another SSAP");
  expect_bytes(b.ask(srd(kInitiate)), kSc, "poll of SAP 49");
  expect_bytes(b.ask(srd(kInitiate, initiate(0, {0, 0}))), refusal(kInitiate, kRs), "Send_Timeout 0");
  expect_bytes(b.ask(srd(kInitiate, initiate(1, {0}))), refusal(kInitiate, kRs), "Initiate of 13 bytes");
  expect_bytes(b.ask(srd(kFirst)), refusal(kFirst, kRs), "a free channel");
  const std::vector<std::pair<Bytes, Bytes>> wrong = {{initiate(9, {0, 0}, 0xFE), {0xD7, 0x80, 0xA9, 0}},
                                                      {initiate(9, {0, 0, 0}), {0x58, 0, 0x17}},
                                                      {initiate(9, {0, 2, 0, 1, 1, 2}), {0x58, 0, 0x17}}};
  for (const auto& [pdu, negative] : wrong) {
    b.ask(srd(kInitiate, pdu));
    expect_bytes(b.ask(srd(kFirst)), answer(kFirst, negative), "a wrong Initiate");
    expect_bytes(b.ask(srd(kFirst)), refusal(kFirst, kRs), "frees the channel");
  }
  connect(b, kFirst, 100);
  const Path second{3, 49, 50};
  expect_bytes(b.ask(srd(second, initiate(0x1234, {9, 2, 8, 3, 0x11, 0x12, 0x21, 0x22, 0x23}))),
               answer(second, {0x56, 0x2F, 0x12, 0x34}), "Initiate of the second channel");
  expect_bytes(b.ask(srd(kInitiate, initiate(1, {0, 0}))), refusal(kInitiate, kRs), "no channel is free");
  expect_bytes(b.ask(srd(kSecond)),
               answer(kSecond, {0x57, 0xF0, 1, 0, 0, 0, 0, 0, 8, 3, 9, 2, 0x21, 0x22, 0x23, 0x11, 0x12}),
               "long Add_Addr");
  expect_bytes(b.ask(srd({3, 48, 50})), refusal(kSecond, kRs), "a channel of another master");
  expect_bytes(b.ask(srd({2, 48, 51})), refusal(kFirst, kRs), "a channel from another SSAP");
}

// Both channels at once: one area, one after the other (V4)
void c2_both(Bench& b) {
  const Bytes first = {0x51, 1, 2, 2, 0xAA, 0xBB}, second = {0x5E, 3, 4, 5};
  expect_bytes(b.ask(srd(kFirst, first)), kSc, "transport on channel 30");
  expect_request(b, kC2, first, "transport in the DPRAM");
  expect_bytes(b.ask(srd(kSecond, second)), kSc, "read on channel 2F");
  expect_no_request(b, "it waits for its turn");
  expect_bytes(b.ask(srd(kSecond, second)), refusal(kSecond, kRr), "a second request");
  give(b, kC2, {0x5E, 3, 4, 1, 0x99});
  expect_bytes(b.ask(srd(kSecond)), kSc, "an answer ahead of its turn");
  give(b, kC2, {0x51, 1, 2, 1, 0xCC});
  expect_request(b, kC2, second, "the other's request has its turn");
  give(b, kC2, {0xDE, 0x80, 0xB7, 1});
  expect_bytes(b.ask(srd(kSecond)), answer(kSecond, {0xDE, 0x80, 0xB7, 1}), "error on channel 2F");
  expect_bytes(b.ask(srd(kFirst, {0x48})), refusal(kFirst, kRr), "Idle while the answer waits");
  expect_bytes(b.ask(srd(kFirst)), answer(kFirst, {0x51, 1, 2, 1, 0xCC}), "answer on channel 30");
  expect_bytes(b.ask(srd(kFirst, {0x48, 0, 0})), kSc, "Idle");
  expect_bytes(b.ask(srd(kFirst)), answer(kFirst, {0x48}), "answer to Idle");
  expect_bytes(b.ask(srd(kFirst, {0x5E, 1, 2, 241})), kSc, "a read of more than 240 bytes");
  expect_request(b, kC2, {0x5E, 1, 2, 241}, "it is the user's to judge");
  give(b, kC2, {0xDE, 0x80, 0xB7, 0});
  b.ask(srd(kFirst));
}

// The telegram is acknowledged, and the channel aborted
void expect_aborted(Bench& b, const Bytes& pdu, uint8_t reason, const char* what) {
  expect_bytes(b.ask(srd(kFirst, pdu)), kSc, what);
  expect_bytes(b.ask(srd(kFirst)), answer(kFirst, {0x58, 0, static_cast<uint8_t>(0x10 | reason)}),
               "the poll behind it");
  expect_bytes(b.ask(srd(kFirst)), refusal(kFirst, kRs), "free behind it");
}

void c2_aborts(Bench& b) {
  expect_bytes(b.ask(srd(kSecond, {0x5E, 1, 1, 1})), kSc, "read on channel 2F");
  abort(b, kSecond);
  expect_bytes(b.ask(srd(kSecond)), refusal(kSecond, kRs), "free behind it");
  b.answer.clear();
  expect_bytes(b.ask(telegram(kFirst, 0x46, {0x5E, 1, 1, 1})), {}, "an SDN that is no abort");
  expect_bytes(b.ask(srd(kFirst)), kSc, "changes nothing");
  for (const Path& path : {Path{3, 48, 50}, Path{2, 48, 51}}) b.ask(telegram(path, 0x46, {0x58}));
  expect_bytes(b.ask(srd(kFirst)), kSc, "neither does an abort of another master or SSAP");
  expect_bytes(b.ask(telegram(kFirst, 0x46, {0x58})), {}, "abort as SDN");
  expect_bytes(b.ask(srd(kFirst)), refusal(kFirst, kRs), "free behind it");
  connect(b, kFirst, 100);
  expect_bytes(b.ask(sd2({0xFF, 0x82, 0x46, 48, 50, 0x58})), {}, "abort as broadcast");
  expect_bytes(b.ask(srd(kFirst)), refusal(kFirst, kRs), "free behind it");
  b.own();
  b.write(0x00F, 0);
  b.step(3);
  b.disown();
  b.ask(srd(kInitiate, initiate(9, {0, 0})));
  expect_aborted(b, {0x5E, 1, 1, 1}, 1, "a request ahead of the poll");
  b.ask(srd(kInitiate, initiate(9, {0, 0})));
  expect_aborted(b, {0x48}, 1, "Idle ahead of the poll");
}

// A wrong PDU on an open channel (V9), and T behind it
void c2_wrong_pdus(Bench& b) {
  const Bytes second_initiate = initiate(9, {0, 0});
  const Bytes all_wrong[] = {{0x5D, 1, 2, 0}, {0x5E, 1, 2}, {0x5E, 1, 2, 0, 0}, {0x51, 1, 2, 3, 0}, {0x5F, 1, 2}};
  for (const Bytes& wrong : all_wrong) {
    connect(b, kFirst, 9);
    expect_aborted(b, wrong, 2, "a wrong PDU");
  }
  connect(b, kFirst, 9);
  expect_aborted(b, second_initiate, 1, "a second Initiate");
  expect_no_request(b, "the user sees none of them");
  for (const int64_t late : {-1, 0}) {
    ask_at(b, srd(kFirst, {0x5D}), connect(b, kFirst, 1) + kUnit / 2);
    const int64_t aborted = decided(b);
    expect_bytes(ask_at(b, srd(kFirst), aborted + kUnit + late),
                 late < 0 ? answer(kFirst, {0x58, 0, 0x12}) : refusal(kFirst, kRs), "free T behind a wrong PDU");
  }
}

// F: the last cycle in which the poll is in time, the first in which it is not, and the second T (V12)
void timer_f(Bench& b) {
  for (const int64_t late : {-1, 0}) {
    b.ask(srd(kInitiate, initiate(1, {1, 2})));
    const Bytes got = ask_at(b, srd(kFirst), decided(b) + kUnit + late);
    expect_bytes(got, answer(kFirst, late < 0 ? Bytes{0x57, 0xF0, 1, 0, 0, 0, 0, 0, 2, 1} : Bytes{0x58, 0, 0x13}),
                 "end of F");
    if (late < 0) abort(b, kFirst);
  }
  for (const int64_t late : {-1, 0}) {
    b.ask(srd(kInitiate, initiate(1, {1, 2})));
    const Bytes got = ask_at(b, srd(kFirst), decided(b) + 2 * kUnit + late);
    expect_bytes(got, late < 0 ? answer(kFirst, {0x58, 0, 0x13}) : refusal(kFirst, kRs), "free after a second T");
  }
}

void timer_i(Bench& b) {
  for (const int64_t late : {-1, 0}) {
    const Bytes got = ask_at(b, srd(kFirst, {0x48}), connect(b, kFirst, 1) + 2 * kUnit + late);
    expect_bytes(got, late < 0 ? kSc : answer(kFirst, {0x58, 0, 0x13}), "end of I");
    if (late < 0) abort(b, kFirst);
  }
  const int64_t opened = connect(b, kFirst, 0x8001);
  expect_bytes(ask_at(b, srd(kFirst), opened + 2 * kUnit + 1000), kSc, "I of 16 bits");
  abort(b, kFirst);
}

// U from the request on, F anew with each poll; the user's answer ends U
void timer_u(Bench& b) {
  for (const int64_t late : {-1, 0}) {
    connect(b, kFirst, 1);
    b.ask(srd(kFirst, {0x5E, 1, 1, 1}));
    const int64_t asked = decided(b);
    ask_at(b, srd(kFirst), asked + 100000);
    expect_bytes(ask_at(b, srd(kFirst), asked + kUnit + late), late < 0 ? kSc : answer(kFirst, {0x58, 0, 0x13}),
                 "end of U");
    if (late < 0) abort(b, kFirst);
  }
  give(b, kC2, {0x5E, 1, 1, 1, 0x55});
  connect(b, kFirst, 1);
  expect_bytes(b.ask(srd(kFirst)), kSc, "an answer to an aborted request");
  b.ask(srd(kFirst, {0x5E, 1, 1, 1}));
  const int64_t asked = decided(b);
  expect_bytes(ask_at(b, srd(kFirst), asked + kUnit), answer(kFirst, {0x58, 0, 0x13}), "F and U at the same cycle");
}

// The second channel's U begins with its turn, at the commit of the first one's answer
void turn(Bench& b) {
  for (const int64_t late : {-1, 0}) {
    connect(b, kFirst, 9);
    connect(b, kSecond, 1);
    b.ask(srd(kFirst, {0x5E, 1, 1, 1}));
    b.ask(srd(kSecond, {0x5E, 2, 2, 2}));
    ask_at(b, srd(kSecond), decided(b) + 200000);
    const int64_t commit = give(b, kC2, {0x5E, 1, 1, 1, 0x66}) + 7 + 4 + 1 + 4;
    ask_at(b, srd(kSecond), commit + 200000);
    expect_bytes(ask_at(b, srd(kSecond), commit + kUnit + late), late < 0 ? kSc : answer(kSecond, {0x58, 0, 0x13}),
                 "end of U of the channel that waited");
    abort(b, kFirst);
    if (late < 0) abort(b, kSecond);
  }
  connect(b, kFirst, 9);
  initialise(b, 0x1D);
  expect_bytes(b.ask(srd(kFirst)), refusal(kFirst, kRs), "an initialisation frees the channels");
}

}  // namespace

void dpv1(Bench& b) {
  b.release_reset();
  b.step(5000);
  initialise(b, 0);
  c1_refusals(b);
  c1_read(b);
  c1_write_and_errors(b);
  longest(b);
  c1_left(b);
  c2_initiate(b);
  c2_both(b);
  c2_aborts(b);
  c2_wrong_pdus(b);
  timer_f(b);
  timer_i(b);
  timer_u(b);
  turn(b);
}

}  // namespace rtl

// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Parts of the RTL's tests that need no chip: expectations, a pin's changes, telegrams of the bus.
#pragma once

#include <cstdint>
#include <cstdio>
#include <vector>

namespace rtl {

using Bytes = std::vector<uint8_t>;

inline int failures = 0;

// A failure; thrown where a fault is looked for, whose first failure ends the run
struct Failure {};
inline bool looks_for_fault = false;
inline void fail() {
  ++failures;
  if (looks_for_fault) throw Failure{};
}

inline void expect(int64_t got, int64_t wanted, const char* what) {
  if (got == wanted) return;
  fail();
  std::printf("FAILED %s: is %lld, not %lld\n", what, static_cast<long long>(got), static_cast<long long>(wanted));
}

inline void expect_bytes(const Bytes& got, const Bytes& wanted, const char* what) {
  if (got == wanted) return;
  fail();
  std::printf("FAILED %s: is", what);
  for (uint8_t byte : got) std::printf(" %02X", byte);
  std::printf(", not");
  for (uint8_t byte : wanted) std::printf(" %02X", byte);
  std::printf("\n");
}

inline uint16_t crc16(const Bytes& bytes) {
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

inline uint8_t sum(const Bytes& bytes) {
  unsigned total = 0;
  for (uint8_t byte : bytes) total += byte;
  return static_cast<uint8_t>(total);
}

inline Bytes sd1(uint8_t da, uint8_t sa, uint8_t fc) { return {0x10, da, sa, fc, sum({da, sa, fc}), 0x16}; }

inline Bytes sd2(const Bytes& body) {
  const auto le = static_cast<uint8_t>(body.size());
  Bytes telegram = {0x68, le, le, 0x68};
  telegram.insert(telegram.end(), body.begin(), body.end());
  telegram.push_back(sum(body));
  telegram.push_back(0x16);
  return telegram;
}

// A request to SAP dsap of station 5 from SAP 62 of master 2, and an answer of it
inline Bytes request(uint8_t fc, uint8_t dsap, const Bytes& data) {
  Bytes body = {0x85, 0x82, fc, dsap, 62};
  body.insert(body.end(), data.begin(), data.end());
  return sd2(body);
}
inline Bytes response(uint8_t fc, uint8_t dsap, const Bytes& data) {
  Bytes body = {0x82, 0x85, fc, 62, dsap};
  body.insert(body.end(), data.begin(), data.end());
  return sd2(body);
}

inline const Bytes kSc = {0xE5};

}  // namespace rtl

// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Who owns the DPRAM (H1, H2, H6): R_REQ and R_STA both hold the chip off, in every order, also through RESET.
#include "rtl_bench.hpp"

namespace rtl {
namespace {

// The edge at which an access starts when both pins have been low since now (P9)
int64_t seen(const Bench& b) { return b.edge + 1 + 2; }

void expect_held_off(Bench& b, const char* what) {
  b.l_req.rise = -1;
  b.step(200);
  expect(b.l_req.rise, -1, what);
}

// Neither pin lets start-up begin alone, and it begins when both are seen low
void start_up_waits(Bench& b) {
  b.pins().r_req_i = b.pins().r_sta_i = 1;
  b.release_reset();
  const int64_t r = seen(b);
  b.step(3);
  expect_held_off(b, "start-up while R_REQ and R_STA are high");
  b.write(0x100, 0xAA);
  b.read(0x100);  // driven, with any value (P12)
  b.pins().r_req_i = 0;
  expect_held_off(b, "start-up while R_STA is high");
  b.pins().r_req_i = 1;
  b.pins().r_sta_i = 0;
  expect_held_off(b, "start-up while R_REQ is high");
  b.step(r + 4096 - b.edge);
  b.pins().r_req_i = 0;
  const int64_t s = seen(b);
  b.step(3000);
  b.wait([&] { return b.l_req.level == 0; }, 100);
  expect_bytes(b.peek(0x100, 1), {0}, "a write ahead of start-up is cleared");
  expect_bytes(b.peek(0x000, 5), {1, 0x0D, 7, 1, 0xC5}, "version, and B004 in the first access behind a late start-up");
  b.pins().reset_i = 0;
  b.step(5);
  b.pins().r_sta_i = 1;
  b.release_reset();
  b.step(3);
  expect_held_off(b, "start-up while R_STA is high since before R");
  b.pins().r_sta_i = 0;
  const int64_t again = seen(b);
  b.l_req.fall = -1;
  b.wait([&] { return b.l_req.fall >= 0; }, 3000);
  expect(b.l_req.rise, again, "start-up begins when R_STA is seen low");
  expect(b.l_req.fall, again + 2054, "a late start-up lasts as long");
  expect(s < again, 1, "both were late");
  b.step(3);
  expect(b.l_req.rise, again + 2055, "first access behind a late start-up");
}

// After a hold long enough that an access is due
void hold(Bench& b) {
  b.own();
  expect_held_off(b, "access while R_REQ and R_STA are high");
}

void expect_starts(Bench& b, const char* what) {
  const int64_t s = seen(b);
  b.step(4);
  expect(b.l_req.rise, s, what);
}

// The two fall one after the other, in either order (text of figure 5)
void releases(Bench& b) {
  hold(b);
  b.pins().r_req_i = 0;
  expect_held_off(b, "access while R_STA is still high");
  b.pins().r_sta_i = 0;
  expect_starts(b, "access when R_STA fell behind R_REQ");
  hold(b);
  b.pins().r_sta_i = 0;
  expect_held_off(b, "access while R_REQ is still high");
  b.pins().r_req_i = 0;
  expect_starts(b, "access when R_REQ fell behind R_STA");
  hold(b);
  b.disown();
  expect_starts(b, "access when both fell");
  // R_REQ rises again before R_STA has fallen: both were never low
  hold(b);
  b.pins().r_req_i = 0;
  b.step();
  b.pins().r_req_i = 1;
  b.step();
  b.pins().r_sta_i = 0;
  expect_held_off(b, "access although the release was taken back");
  b.disown();
  // one cycle with both low is a release
  hold(b);
  b.disown();
  const int64_t s = seen(b);
  b.step();
  b.pins().r_req_i = 1;
  b.step(10);
  expect(b.l_req.rise, s, "access in a release of one cycle");
  b.disown();
}

}  // namespace

void ownership(Bench& b) {
  start_up_waits(b);
  releases(b);
}

}  // namespace rtl

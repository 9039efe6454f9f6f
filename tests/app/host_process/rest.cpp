// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// A part of the device in C++.
#include "driver/host/dsdpv1_bench.h"

namespace device {
namespace {

void pass(int ms) {
  for (int i = 0; i < ms; ++i) dsdpv1_bench_wait_ns(1000000);
}

}  // namespace

void rest() { pass(11); }

}  // namespace device

extern "C" void rest(void) { device::rest(); }

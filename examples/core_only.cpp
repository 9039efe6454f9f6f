// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// The DSDPV1 core without SystemC: pins in, pin changes out, advance. A user CPU releases RESET, takes the DPRAM by the
// handshake and reads B000..B004 through the host port.
#include <cstdio>

#include "model/dsdpv1/chip.hpp"

using dsdpv1::Chip;
using dsdpv1::Pin;
using dsdpv1::Tick;

namespace {

constexpr Tick kNs = dsdpv1::profibus::kTicksPerNs;
constexpr Tick kUs = 1000 * kNs;

void print_change(void*, Tick at, Pin pin, dsdpv1::Level level) {
  if (pin == Pin::kDOut && level < 0) return;  // only readable values
  std::printf("%12.3f us  %-6s %0*X\n", static_cast<double>(at) / kUs, dsdpv1::name(pin), pin == Pin::kDOut ? 2 : 1,
              static_cast<unsigned>(level));
}

// Table 15: A no later than RD's fall, D certain 31.25 ns after it.
dsdpv1::Level read(Chip& chip, Tick& now, dsdpv1::Level address) {
  chip.set(now, Pin::kA, address);
  chip.set(now, Pin::kCsr, 0);
  chip.set(now += 10 * kNs, Pin::kRd, 0);
  const dsdpv1::Level value = chip.sample(now += 40 * kNs);  // P5: before 31.25 ns it would be X, and reported
  chip.set(now, Pin::kRd, 1);
  chip.set(now, Pin::kCsr, 1);
  now += 10 * kNs;
  return value;
}

}  // namespace

int main() {
  Chip chip;  // RESET is low
  chip.set(1 * kUs, Pin::kReset, 1);
  chip.advance(150 * kUs);  // D1: B004 = 0xC5 after 4096 cycles, 85.3 us

  Tick now = 150 * kUs;
  chip.watch({print_change, nullptr}, dsdpv1::kOutputPins);
  chip.set(now, Pin::kRReq, 1);
  do {
    chip.advance(now += 100 * kNs);  // H2: the chip may still start during the first 62.5 ns
  } while (chip.level(Pin::kLReq) != 0 || chip.level(Pin::kLSta) != 0);
  chip.set(now, Pin::kRSta, 1);
  now += 50 * kNs;

  for (dsdpv1::Level address = 0; address <= 4; ++address)
    std::printf("B%03X = %02X\n", address, read(chip, now, address));
  chip.set(now, Pin::kRSta, 0);
  chip.set(now, Pin::kRReq, 0);
  chip.advance(now + 1 * kUs);
}

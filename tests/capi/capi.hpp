#pragma once
// Shared by the tests of the C API.
#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <vector>

#include "bus/wire/uart.hpp"
#include "dsdpv1/dsdpv1.h"

inline bool operator==(const dpsim_change& a, const dpsim_change& b) {
  return a.tick == b.tick && a.station == b.station && a.pin == b.pin && a.level == b.level;
}
inline std::ostream& operator<<(std::ostream& out, const dpsim_change& change) {
  return out << change.tick << " " << change.station << "." << change.pin << "=" << change.level;
}

namespace dsdpv1::capi_test {

/// A call that must succeed.
inline void ok(dpsim_status status) { ASSERT_EQ(status, DPSIM_OK) << dpsim_error_message(); }

template <class T>
T sized() {
  T made{};
  made.size = sizeof made;
  return made;
}

struct Destroy {
  void operator()(dpsim_chip* chip) const { dpsim_chip_destroy(chip); }
  void operator()(dpsim_bus* bus) const { dpsim_bus_destroy(bus); }
  void operator()(dpsim_checker* checker) const { dpsim_checker_destroy(checker); }
  void operator()(dpsim_scoreboard* scoreboard) const { dpsim_scoreboard_destroy(scoreboard); }
  void operator()(dpsim_gsd* gsd) const { dpsim_gsd_destroy(gsd); }
  void operator()(dpsim_run* run) const { dpsim_run_destroy(run); }
};
template <class T>
using Owned = std::unique_ptr<T, Destroy>;

inline Owned<dpsim_chip> make_chip(dpsim_engine engine = DPSIM_ENGINE_SKIP) {
  auto options = sized<dpsim_chip_options>();
  options.engine = engine;
  dpsim_chip* chip = nullptr;
  ok(dpsim_chip_create(&options, &chip));
  return Owned<dpsim_chip>(chip);
}
inline Owned<dpsim_bus> make_bus() {
  dpsim_bus* bus = nullptr;
  ok(dpsim_bus_create(nullptr, &bus));
  return Owned<dpsim_bus>(bus);
}
inline Owned<dpsim_checker> make_checker() {
  dpsim_checker* checker = nullptr;
  ok(dpsim_checker_create(nullptr, &checker));
  return Owned<dpsim_checker>(checker);
}

/// Everything returned by `read`, in small pieces.
template <class Object>
std::vector<dpsim_change> drain(dpsim_status (*read)(Object*, dpsim_change*, size_t, size_t*), Object* from) {
  std::vector<dpsim_change> all;
  std::vector<dpsim_change> part(100);
  for (size_t count = part.size(); count == part.size();) {
    ok(read(from, part.data(), part.size(), &count));
    all.insert(all.end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return all;
}

/// Sends characters to PBRXD of a chip without a bus, bit by bit; returns the end of the last one, which the chip has
/// reached.
template <class Bytes>
uint64_t receive_edges(dpsim_chip* chip, uint64_t at, uint32_t bit, const Bytes& bytes) {
  for (const uint8_t byte : bytes)
    for (int i = 0; i < bus::kCharacterBits; ++i, at += bit)
      ok(dpsim_chip_set(chip, at, DPSIM_DSDPV1_PBRXD,
                        static_cast<dpsim_level>((bus::Character::of(byte).bits >> i) & 1)));
  ok(dpsim_chip_advance(chip, at));
  return at;
}

constexpr uint64_t kCycle = DPSIM_TICKS_PER_CYCLE;
constexpr uint64_t kUs = 12'000, kMs = 12'000'000;

}  // namespace dsdpv1::capi_test

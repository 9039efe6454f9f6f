#pragma once
// The outputs of a chip, and its answers to queries.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/state/aimed.hpp"

namespace dsdpv1::state_test {

/// The way to evaluate and observe a chip: it dozes if L_REQ and L_STA have no observer.
enum class Way : std::uint8_t { kSkip, kDoze, kStep };
const char* words(Way way);

struct Heard {
  std::vector<Input> pins;
  std::vector<profibus::Event> events;
};
bool operator==(const Heard& a, const Heard& b);

/// A chip that reports to `heard`, which outlives it.
std::unique_ptr<Chip> make_chip(Config config, Way way, Heard& heard);

/// Counters, levels of all pins, runs that it need not hear and, in step mode, its internal state.
std::string asked(const Chip& chip, const Config& config, Way way);

/// The inputs of `slave` from number `from` on, up to and including `until`.
void play(Chip& chip, const Recorded& slave, std::size_t from, Tick until);

}  // namespace dsdpv1::state_test

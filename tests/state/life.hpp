#pragma once
// The output of a chip, and its answers to queries.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/state/aimed.hpp"

namespace dsdpv1::state_test {

/// The engine and observers of a chip: it dozes if L_REQ and L_STA have no observer.
enum class Way : std::uint8_t { kSkip, kDoze, kStep };
const char* words(Way way);

struct Heard {
  std::vector<Input> pins;
  std::vector<profibus::Event> events;
};
bool operator==(const Heard& a, const Heard& b);

/// A chip that tells `heard`, which outlives it.
std::unique_ptr<Chip> make_chip(Config config, Way way, Heard& heard);

/// Counters, levels of all pins, runs that it need not hear and, in step, its inner state.
std::string asked(const Chip& chip, const Config& config, Way way);

/// The inputs of `slave` from the number `from` on, as far as they come before or at `until`.
void play(Chip& chip, const Recorded& slave, std::size_t from, Tick until);

}  // namespace dsdpv1::state_test

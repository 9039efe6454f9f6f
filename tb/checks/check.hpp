#pragma once
// The checks as a table: what each one asks for, where that stands, what it measures, and its limit.
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "bus/time.hpp"

namespace checks {

using bus::Tick;

enum class Check : std::uint8_t {
#define X(enumerator, ...) enumerator,
#include "tb/checks/check_table.inc"
#undef X
};
/// All of them, in the order of the table.
constexpr Check kAllChecks[] = {
#define X(enumerator, ...) Check::enumerator,
#include "tb/checks/check_table.inc"
#undef X
};
constexpr std::size_t kCheckCount = std::size(kAllChecks);

/// What the limit is.
enum class Bound : std::uint8_t {
  kMin,   ///< the least allowed value: margin = value - limit
  kMax,   ///< the greatest allowed value: margin = limit - value
  kRule,  ///< no value: kept or not
};

/// Only measured, never violated.
constexpr Tick kNoLimit = bus::kNever;

struct Rule {
  const char* id;  ///< stable: in scenarios, logs and result files
  Bound bound;
  Tick limit;          ///< default, in ticks of 1/12 ns; kNoLimit, or 0 for Bound::kRule
  std::uint32_t pins;  ///< whose history is shown with a violation
  const char* rule;    ///< what must hold, one sentence without its stop
  const char* clause;  ///< of the datasheet, and rulings of docs/chip.md
  const char* formula;
  const char* source;  ///< of the default limit
  const char* advice;  ///< what to do about a violation
};

const Rule& rule(Check check);

/// The limits of a run: the defaults, or what a scenario says.
struct Limit {
  bool on = true;
  Tick value = 0;  ///< of Bound::kMin and Bound::kMax, ticks
};

class Limits {
 public:
  Limits();
  Limit& operator[](Check check) { return limits_.at(static_cast<std::size_t>(check)); }
  const Limit& operator[](Check check) const { return limits_.at(static_cast<std::size_t>(check)); }

 private:
  std::array<Limit, kCheckCount> limits_;
};

}  // namespace checks

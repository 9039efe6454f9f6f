#pragma once
// A check as a row of its chip's table: its rule, clause, measurement and limit.
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "bus/time.hpp"

namespace dsdpv1::checks {

using bus::Tick;

/// Meaning of the limit.
enum class Bound : std::uint8_t {
  kMin,   ///< the least allowed value: margin = value - limit
  kMax,   ///< the greatest allowed value: margin = limit - value
  kRule,  ///< no value: kept or not
  kMost,  ///< the greatest allowed number, not a time: without margins
};

/// Only measured, never violated.
constexpr Tick kNoLimit = bus::kNever;

struct Rule {
  const char* id;  ///< stable: in scenarios, logs and result files
  Bound bound;
  Tick limit;          ///< default, in ticks of 1/12 ns, for Bound::kMost a number; kNoLimit, or 0 for Bound::kRule
  std::uint32_t pins;  ///< pins whose history is shown with a violation, a bit for each pin of the chip
  const char* rule;    ///< what must hold, one sentence without its stop
  const char* clause;  ///< of the datasheet, and rulings
  const char* formula;
  const char* source;  ///< of the default limit
  const char* advice;  ///< what to do about a violation
};

/// The checks of a chip, in the order in which they are reported.
using RuleTable = std::vector<Rule>;

/// The index of a check in its chip's table; made from the chip's enumerators.
struct CheckId {
  std::size_t index = 0;

  CheckId() = default;
  explicit constexpr CheckId(std::size_t place) : index(place) {}
  /// Converts a chip's enumerators.
  template <class E, class = std::enable_if_t<std::is_enum_v<E>>>
  // NOLINTNEXTLINE(google-explicit-constructor)
  constexpr CheckId(E check) : index(static_cast<std::size_t>(check)) {}
};

inline bool operator==(CheckId a, CheckId b) { return a.index == b.index; }
inline bool operator!=(CheckId a, CheckId b) { return a.index != b.index; }

/// The limit in a run: the default, or the scenario's.
struct Limit {
  bool on = true;
  Tick value = 0;  ///< for Bound::kMin and kMax ticks, for kMost a number
};

class Limits {
 public:
  Limits() = default;
  explicit Limits(const RuleTable& rules) {
    for (const Rule& rule : rules) limits_.push_back({true, rule.limit});
  }
  Limit& operator[](CheckId check) { return limits_.at(check.index); }
  const Limit& operator[](CheckId check) const { return limits_.at(check.index); }

 private:
  std::vector<Limit> limits_;
};

}  // namespace dsdpv1::checks

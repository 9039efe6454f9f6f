#pragma once
// Compares the pin changes of two chips with the same inputs.
//
// A pin without tolerance must have the same level on both sides at every tick. A pin with a tolerance must make the
// same changes in the same order, each within so many cycles of the other side's. An X of the model matches anything
// (P5, A43).
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "cosim/rtl.hpp"

namespace dsdpv1::cosim {

/// The first difference; a level that did not come within the tolerance is `nullopt`.
struct PinDifference {
  Tick at = 0;
  PinNumber pin = 0;
  std::optional<Level> model, rtl;
};

/// Cycles by which a pin of the RTL may be earlier or later, by pin; 0: exactly.
using Tolerances = std::array<int, kMostPins>;

class PinComparator {
 public:
  explicit PinComparator(const Tolerances& tolerances = {}) : tolerances_(tolerances) {}

  /// Sets the levels at the beginning; default 0.
  void begin(PinNumber pin, Level model, Level rtl);
  void model_changed(Tick at, PinNumber pin, Level level) { model_.push_back({at, pin, level}); }
  void rtl_changed(Tick at, PinNumber pin, Level level) { rtl_.push_back({at, pin, level}); }

  /// Compares everything before `horizon`, which both sides have reached. Returns the first difference; after it
  /// comparison stops.
  std::optional<PinDifference> settle(Tick horizon);
  /// Changes of the model that the RTL made as well.
  std::uint64_t matched() const { return matched_; }

 private:
  struct Change {
    Tick at;
    PinNumber pin;
    Level level;
  };
  struct Late {
    Tick at;
    Level level;
  };
  struct State {
    Level model = 0, rtl = 0;
    bool model_touched = false, rtl_touched = false;
    std::deque<Late> model_ahead, rtl_ahead;  ///< tolerant pins: changes that the other side has not made yet
  };
  Tick tolerance(PinNumber pin) const { return tolerances_.at(pin) * bus::kTicksPerCycle; }
  static bool matches(Level model, Level rtl) { return model == rtl || model == tb::kLevelX; }
  void take(Tick at);
  std::optional<PinDifference> compare(Tick at);
  std::optional<PinDifference> compare_exact(Tick at, PinNumber pin);
  std::optional<PinDifference> compare_tolerant(Tick at, PinNumber pin);
  std::optional<PinDifference> overdue(Tick horizon);

  const Tolerances tolerances_;
  std::array<State, kMostPins> states_;
  std::vector<Change> model_, rtl_;
  std::size_t model_next_ = 0, rtl_next_ = 0;
  std::uint32_t touched_ = 0;
  std::uint64_t matched_ = 0;
};

}  // namespace dsdpv1::cosim

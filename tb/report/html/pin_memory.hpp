#pragma once
// The last changes of each pin of a chip, enough for a picture.
#include <deque>
#include <optional>
#include <vector>

#include "bus/time.hpp"
#include "tb/chip/pins/pins.hpp"
#include "tb/chip/timing_diagram.hpp"

namespace dsdpv1::tb::html {

using bus::Tick;

struct PinStep {
  Tick at = 0;
  Level level = 0;
};

/// A pin from one time to another.
struct PinTrace {
  PinNumber pin = 0;
  Level first = 0;  ///< the level at the begin
  std::vector<PinStep> steps;
};

class PinMemory {
 public:
  static constexpr std::size_t kDepth = 4096;  ///< changes a pin: an answer of 255 characters and the request before it

  static constexpr std::size_t kLooked = 64;

  explicit PinMemory(std::size_t pins) : pins_(pins) {}
  void begin(PinNumber pin, Level level) { pins_.at(pin).before = level; }
  void add(Tick at, PinNumber pin, Level level);

  Level level(PinNumber pin) const;
  /// True if the change of `pin` to `level` at `at`, the last one added, is this edge.
  bool is(const DiagramEdge& edge, Tick at, PinNumber pin, Level level) const;
  /// The last such edge at or before `at`. With conditions only the last kLooked changes are searched.
  std::optional<Tick> last(const DiagramEdge& edge, Tick at) const;
  /// The first such edge from `from` to `to`.
  std::optional<Tick> first(const DiagramEdge& edge, Tick from, Tick to) const;
  PinTrace trace(PinNumber pin, Tick from, Tick to) const;

 private:
  struct Pin {
    Level before = 0;  ///< the first of `steps`
    std::deque<PinStep> steps;
  };
  bool holds(const DiagramEdge& edge, Tick at) const;
  bool had(const PinLevel& wanted, Tick at) const;

  std::vector<Pin> pins_;
};

}  // namespace dsdpv1::tb::html

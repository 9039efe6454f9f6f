#pragma once
// One Surroundings for each scope of a side that has pins of a chip.
#include <map>

#include "lab/compare/side.hpp"
#include "lab/compare/surroundings.hpp"

namespace dsdpv1::tb::compare {

class Watchers {
 public:
  /// Observes the pins in scopes of `side` by their names, ignoring case, with or without _i and _o. `make` may be
  /// empty.
  Watchers(Side& side, const MakeSurroundings& make);
  bool empty() const { return pins_.empty(); }
  /// Processes the changes up to `now`.
  void settle(bus::Tick now);
  /// The report of the chip in this scope of the side, or of the only chip.
  std::vector<Line> lines(const std::string& scope, bus::Tick now) const;

 private:
  struct Pin {
    Surroundings* of = nullptr;
    std::size_t number = 0;
    Probe probe;
  };
  Side& side_;
  std::map<std::string, std::unique_ptr<Surroundings>> by_scope_;
  std::vector<Pin> pins_;
  Touched touched_;
};

}  // namespace dsdpv1::tb::compare

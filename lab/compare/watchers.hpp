#pragma once
// One Surroundings for each scope of a side that has pins of a chip.
#include <map>

#include "lab/compare/side.hpp"
#include "lab/compare/surroundings.hpp"

namespace dsdpv1::tb::compare {

class Watchers {
 public:
  /// Looks at the pins that stand in scopes of `side` under their own names, in capitals or not, with or without _i and
  /// _o. `make` may be empty.
  Watchers(Side& side, const MakeSurroundings& make);
  bool empty() const { return pins_.empty(); }
  /// Takes what has changed up to `now`.
  void settle(bus::Tick now);
  /// Of the chip in this scope of the side; of the only chip where there is one.
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

#pragma once
#include <functional>
#include <vector>

#include "model/dsdpv1/chip.hpp"

namespace dsdpv1 {

struct PinChange {
  dsdpv1::Tick at;
  dsdpv1::Pin pin;
  dsdpv1::Level level;
  bool operator==(const PinChange& other) const { return at == other.at && pin == other.pin && level == other.level; }
};

struct FakePins {
  std::vector<PinChange> changes;
  dsdpv1::Tick now = 0;
  dsdpv1::Level high = 0;  ///< level of every single pin
  std::function<dsdpv1::Level(dsdpv1::Tick)> data;
};

FakePins& fake_pins();

}  // namespace dsdpv1

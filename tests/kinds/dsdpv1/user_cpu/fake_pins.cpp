// The core's Chip, replaced by one that records its input pins and drives D as it is told.
#include "tests/kinds/dsdpv1/user_cpu/fake_pins.hpp"

namespace dsdpv1 {

FakePins& fake_pins() {
  static FakePins pins;
  return pins;
}

struct Chip::Impl {};

Chip::Chip(const Config&) {}
Chip::~Chip() = default;

void Chip::set(Tick at, Pin pin, Level level) { fake_pins().changes.push_back({at, pin, level}); }
bool Chip::carry_out(Tick, const HostAccess&, Level&) { return false; }
bool Chip::is_private(Tick, const HostAccess&) { return false; }
void Chip::advance(Tick to) { fake_pins().now = to; }

Level Chip::level(Pin pin) const { return pin == Pin::kDOut ? fake_pins().data(fake_pins().now) : fake_pins().high; }

Level Chip::sample(Tick at) {
  advance(at);
  return level(Pin::kDOut);
}

}  // namespace dsdpv1

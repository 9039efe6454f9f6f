#include "board/cpu/polling.hpp"

namespace dsdpv1::arm {

void Polling::looked(std::uint64_t until) {
  if (looks_ > kMostLooks) end();
  if (!begun_) return begin(looks_at_stores_);
  ++looks_;
  if (engine_.read(Register::kPc) != first_.pc) return;
  const bool alike = engine_.state() == first_ && !engine_.has_stored();
  if (!alike || !looks_at_stores_) return begin(alike);
  const std::uint64_t pass = engine_.now() - began_;
  if (until > engine_.now())
    engine_.repeat((until - engine_.now() - 1) / pass, pass, engine_.instructions() - instructions_);
  begin(true);
}

/// Stores are not observed before two passes have left the registers alike: that makes them slow.
void Polling::begin(bool looks_at_stores) {
  begun_ = true;
  looks_at_stores_ = looks_at_stores;
  engine_.look_at_stores(looks_at_stores);
  first_ = engine_.state();
  began_ = engine_.now();
  instructions_ = engine_.instructions();
  looks_ = 0;
}

void Polling::end() {
  if (looks_at_stores_) engine_.look_at_stores(false);
  begun_ = looks_at_stores_ = false;
}

void Polling::pass_by() {
  if ((begun_ || looks_at_stores_) && engine_.instructions() - instructions_ > kMostInstructions) end();
}

}  // namespace dsdpv1::arm

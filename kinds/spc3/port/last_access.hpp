#pragma once
// The user's last access to a chip of the SPC3 family as text, derived from the chip's inputs.
#include <string>

#include "kinds/spc3/port/bus_reader.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb {

/// A read counts from its begin, a write from its end.
class Spc3LastAccess : public AccessReader, private spc3_bus::AccessSink {
 public:
  void pin(Tick at, PinNumber pin, Level level) override { reader_.pin(at, pin, level); }
  /// "read 008 at cycle 84795 + 122 ticks (1766.573 us)", "write 016 := 05 at ...", "none".
  std::string words() const override;

 private:
  void access_began(const spc3_bus::BusAccess& access) override {
    if (!access.write) keep(access.began, access);
  }
  void access_ended(Tick at, const spc3_bus::BusAccess& access) override {
    if (access.write) keep(at, access);
  }
  void keep(Tick at, const spc3_bus::BusAccess& access) {
    at_ = at;
    last_ = access;
  }

  spc3_bus::BusReader reader_{*this};
  spc3_bus::BusAccess last_;
  Tick at_ = -1;  ///< -1: none
};

}  // namespace dsdpv1::tb

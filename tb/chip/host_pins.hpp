#pragma once
// The pins that a host bus needs, whoever is behind them: the core, or the core and RTL side by side.
#include "model/dsdpv1/chip.hpp"

namespace dsdpv1::user_cpu {

class HostPins {
 public:
  virtual ~HostPins() = default;
  /// As dsdpv1::Chip has them.
  virtual void set(dsdpv1::Tick at, dsdpv1::Pin pin, dsdpv1::Level level) = 0;
  virtual void advance(dsdpv1::Tick to) = 0;
  virtual dsdpv1::Level level(dsdpv1::Pin pin) const = 0;
  virtual dsdpv1::Level sample(dsdpv1::Tick at) = 0;
  /// See dsdpv1::Chip; who wants each edge carries nothing out.
  virtual bool carry_out(dsdpv1::Tick /*begin*/, const dsdpv1::HostAccess& /*access*/, dsdpv1::Level& /*sampled*/) {
    return false;
  }
  /// See dsdpv1::Chip::is_private.
  virtual bool is_private(dsdpv1::Tick /*begin*/, const dsdpv1::HostAccess& /*access*/) { return false; }
};

/// Those of the core.
class CoreHostPins : public HostPins {
 public:
  explicit CoreHostPins(dsdpv1::Chip& chip) : chip_(chip) {}
  void set(dsdpv1::Tick at, dsdpv1::Pin pin, dsdpv1::Level level) override { chip_.set(at, pin, level); }
  void advance(dsdpv1::Tick to) override { chip_.advance(to); }
  dsdpv1::Level level(dsdpv1::Pin pin) const override { return chip_.level(pin); }
  dsdpv1::Level sample(dsdpv1::Tick at) override { return chip_.sample(at); }
  bool carry_out(dsdpv1::Tick begin, const dsdpv1::HostAccess& access, dsdpv1::Level& sampled) override {
    return chip_.carry_out(begin, access, sampled);
  }
  bool is_private(dsdpv1::Tick begin, const dsdpv1::HostAccess& access) override {
    return chip_.is_private(begin, access);
  }

 private:
  dsdpv1::Chip& chip_;
};

}  // namespace dsdpv1::user_cpu

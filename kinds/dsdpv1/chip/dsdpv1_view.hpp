#pragma once
// A DSDPV1 on the bench, whichever way it is executed.
#include "kinds/dsdpv1/user_cpu/host_bus.hpp"
#include "model/dsdpv1/chip.hpp"
#include "tb/chip/chip_view.hpp"

namespace dsdpv1::tb {

/// What the core says of itself, as the bench has it.
ChipStatus status_of(const dsdpv1::Chip& core);

class Dsdpv1View : public ChipView {
 public:
  virtual user_cpu::HostBus& host_bus() = 0;
  /// The core that tells states, counters and events: the chip itself, or one beside it on the same inputs.
  virtual const dsdpv1::Chip& core() const = 0;

  ChipStatus status() const final {
    hear_runs();
    return status_of(core());
  }
  std::uint8_t address() const final { return core().address(); }
  Level level(PinNumber pin) const final { return core().level(static_cast<dsdpv1::Pin>(pin)); }

 protected:
  /// Telegrams of others that it has not been told of yet.
  virtual void hear_runs() const {}
  /// Tells a change of a pin to whoever listens.
  void tell(Tick at, dsdpv1::Pin pin, dsdpv1::Level level) const {
    if (pin == dsdpv1::Pin::kIntr0 && on_interrupt) on_interrupt(at, level != 0);
    if (on_pin) on_pin(at, static_cast<PinNumber>(pin), level);
  }
  /// What the user CPU does, to whoever listens.
  void tell_action(Tick at, const user_cpu::Access& access) const;
  void tell_action(Tick at, const char* pin, bool level) const;
};

}  // namespace dsdpv1::tb

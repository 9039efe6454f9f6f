#pragma once
// One chip as the bench drives and sees it, whichever way it is executed (pins of the core, TLM module).
#include <functional>

#include "bus/wire/segment.hpp"
#include "model/dsdpv1/chip.hpp"
#include "tb/user_cpu/host_bus.hpp"

namespace tb {

using bus::Tick;

class ChipView {
 public:
  virtual ~ChipView() = default;

  virtual void set_reset(Tick at, bool level) = 0;
  /// The user CPU was reset at `at`: its bus is idle again, an access begun is forgotten.
  virtual void reset_host(Tick at) = 0;
  virtual user_cpu::HostBus& host_bus() = 0;
  virtual bus::StationId station() const = 0;
  /// Status and levels as of the last evaluation; `sync` brings it to the present time.
  virtual const dsdpv1::Chip& chip() const = 0;
  virtual void sync(Tick now) = 0;

  /// Changes of the watched pins, in order of time.
  std::function<void(Tick at, dsdpv1::Pin pin, dsdpv1::Level level)> on_pin;
  std::function<void(const profibus::Event&)> on_event;
  /// The user CPU begins a read, whose first edge is still to come, and samples D at `sample`: no pin shows that.
  std::function<void(Tick sample)> on_read;
};

/// All input pins.
constexpr std::uint32_t kInputPins = dsdpv1::mask(dsdpv1::Pin::kLReq) - 1;

/// The output pins that the bench itself needs.
constexpr std::uint32_t kBusPins =
    dsdpv1::mask(dsdpv1::Pin::kPbtxd) | dsdpv1::mask(dsdpv1::Pin::kPbrts) | dsdpv1::mask(dsdpv1::Pin::kIntr0);

}  // namespace tb

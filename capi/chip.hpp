#pragma once
// A chip as the object of the header's handle, alone or on a bus.
#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "bus/wire/character_run.hpp"
#include "capi/changes.hpp"
#include "capi/clock.hpp"
#include "capi/kind.hpp"
#include "capi/names.hpp"
#include "capi/serial.hpp"
#include "model/profibus/event.hpp"
#include "tb/chip/pin_device.hpp"

namespace dsdpv1::capi {

/// Events of a chip on their way to the caller.
class ChipEvents {
 public:
  ChipEvents(const Kind& kind, std::uint16_t station, Clock& clock) : kind_(kind), station_(station), clock_(clock) {}
  void tell(dpsim_chip_event_fn fn, void* user) {
    fn_ = fn;
    user_ = user;
  }
  void add(const profibus::Event& event) const;

 private:
  const Kind& kind_;
  std::uint16_t station_;
  Clock& clock_;
  dpsim_chip_event_fn fn_ = nullptr;
  void* user_ = nullptr;
};

/// Converts the header's options; throws for unknown names and values.
ChipPlan plan_of(const dpsim_chip_options& options, const Kind& kind, const std::string& usual_name);

}  // namespace dsdpv1::capi

struct dpsim_bus;

struct dpsim_chip {
  using Tick = capi::Tick;
  using Level = tb::Level;
  using PinNumber = tb::PinNumber;
  static constexpr Tick kNotHeard = -1;

  /// Without a bus: only the core.
  dpsim_chip(const capi::Kind& its_kind, capi::ChipPlan plan);
  /// The next station of a bus, with the caller as its user.
  dpsim_chip(const capi::Kind& its_kind, capi::ChipPlan plan, dpsim_bus& its_bus);
  dpsim_chip(const dpsim_chip&) = delete;
  dpsim_chip& operator=(const dpsim_chip&) = delete;

  // All values are valid, and no tick is before clock.now.
  void set(Tick at, PinNumber pin, Level level) {
    if ((watched_ & tb::mask_of(pin)) == 0) return device_->set(at, pin, level);
    set_watched(at, pin, level);
  }
  void advance(Tick to) { device_->advance(to); }
  /// Receives characters as a whole, from their start on: returns the tick up to which it needs none of their changes;
  /// kNotHeard: it needs all. For a chip without a bus.
  Tick hear(const dsdpv1::bus::CharacterRun& run);
  Level level(PinNumber pin) const {
    if (heard_ != nullptr && pin == line_pin()) return heard_level();
    return device_->level(pin);
  }
  void watch(tb::PinMask pins);
  tb::PinDevice& device() { return *device_; }
  const tb::PinDevice& device() const { return *device_; }
  /// The input that receives the line if the chip is on a bus.
  PinNumber line_pin() const { return kind.chip.board_pins().rxd; }

  /// Throws unless the pin is an input and can have this level.
  void check(std::uint16_t pin, Level level) const {
    if (pin >= levels_.size() || !levels_[pin].has(level)) refuse(pin, level);
  }
  /// Sets such a pin at a time that is not in the past; else throws.
  void set_checked(std::uint64_t tick, std::uint16_t pin, Level level) {
    check(pin, level);
    const Tick at = capi::tick_from(tick, clock.now);
    set(at, static_cast<PinNumber>(pin), level);
    clock.now = at;
  }

  /// The value of a parameter, with which the chip was made.
  std::int64_t parameter(const std::string& name) const;
  void open_uart(PinNumber txd, const dsdpv1::UartTiming& timing);
  /// Throws before open_uart.
  capi::UserUart& uart() const;
  /// After the device has been restored.
  void resume();

  const capi::Kind& kind;
  dpsim_bus* const bus;  ///< null: alone
  const std::uint16_t station;

 private:
  capi::Clock own_;

 public:
  capi::Clock& clock;  ///< its own, or that of its bus
  capi::Changes changes;
  capi::ChipEvents events;

 private:
  struct Levels {
    Level low = 0;
    std::uint16_t count = 0;  ///< from `low` on; 0: it cannot be set
    bool has(Level level) const { return static_cast<std::uint16_t>(level - low) < count; }
  };
  struct Made {
    std::unique_ptr<const capi::ChipPlan> plan;  ///< whose settings the device may refer to
    std::unique_ptr<tb::PinDevice> device;
  };
  static Made make(const capi::Kind& kind, capi::ChipPlan plan, dpsim_bus* bus);
  dpsim_chip(const capi::Kind& its_kind, dpsim_bus* its_bus, Made made);
  std::array<Levels, tb::kMostPins> levels_of(const capi::Kind& kind) const;
  [[noreturn]] void refuse(std::uint16_t number, Level level) const;
  void set_watched(Tick at, PinNumber pin, Level level);
  Level heard_level() const;
  static void tell(void* self, Tick at, PinNumber pin, Level level);
  static void keep(void* self, Tick at, PinNumber pin, Level level);
  static void hear_txd(void* self, Tick at, PinNumber pin, Level level);
  void watch_device();

  std::array<Levels, tb::kMostPins> levels_;  ///< by pin
  const std::unique_ptr<const capi::ChipPlan> plan_;
  const std::unique_ptr<tb::PinDevice> device_;
  std::unique_ptr<capi::UserUart> uart_;
  tb::PinMask watched_ = 0;
  tb::PinSink sink_;
  dpsim_change told_{};
  const dsdpv1::bus::CharacterRun* heard_ = nullptr;  ///< during the call
};

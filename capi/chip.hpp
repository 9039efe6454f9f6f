#pragma once
// A chip behind the header's handle, alone or on a bus.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bus/wire/character_run.hpp"
#include "capi/changes.hpp"
#include "capi/clock.hpp"
#include "capi/kind.hpp"
#include "capi/names.hpp"
#include "model/profibus/event.hpp"
#include "tb/chip/chip_view.hpp"

namespace dsdpv1::capi {

/// Events of a chip on their way out.
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

/// What the header says of a chip by its options; throws for names and values that there are not.
ChipPlan plan_of(const dpsim_chip_options& options, const Kind& kind, const std::string& usual_name);

}  // namespace dsdpv1::capi

struct dpsim_chip {
  using Tick = capi::Tick;
  using Level = tb::Level;
  using PinNumber = tb::PinNumber;
  static constexpr Tick kNotHeard = -1;

  /// Alone.
  explicit dpsim_chip(const capi::Kind& its_kind);
  /// The next station of a bus.
  dpsim_chip(const capi::Kind& its_kind, dpsim_bus& its_bus);
  virtual ~dpsim_chip() = default;
  dpsim_chip(const dpsim_chip&) = delete;
  dpsim_chip& operator=(const dpsim_chip&) = delete;

  // All values are right, and no tick is before clock.now.
  virtual void set(Tick at, PinNumber pin, Level level) = 0;
  virtual void advance(Tick to) = 0;
  /// Hears characters as a whole, from their start on: the tick up to which it needs none of their changes, kNotHeard:
  /// it needs all.
  virtual Tick hear(const dsdpv1::bus::CharacterRun& /*run*/) { return kNotHeard; }
  virtual Level sample(Tick at) = 0;
  virtual Tick next() = 0;
  virtual Tick now() const = 0;
  virtual Level level(PinNumber pin) const = 0;
  virtual void watch(tb::PinMask pins) = 0;
  virtual tb::ChipStatus status() const = 0;
  virtual std::uint8_t peek(std::uint16_t address) const = 0;
  virtual void poke(std::uint16_t address, std::uint8_t value) = 0;
  // Of a chip alone.
  virtual std::vector<std::uint8_t> save() const = 0;
  /// Throws for bytes that are no state of this chip.
  virtual void restore(const std::uint8_t* bytes, std::size_t size) = 0;

  /// Sets a pin if it is an input and has such a level at a time that is not over; else throws.
  void set_checked(std::uint64_t tick, std::uint16_t pin, Level level) {
    if (pin >= levels_.size() || !levels_[pin].has(level)) refuse(pin, level);
    const Tick at = capi::tick_from(tick, clock.now);
    set(at, static_cast<PinNumber>(pin), level);
    clock.now = at;
  }

  const capi::Kind& kind;
  dpsim_bus* const bus;  ///< null: alone
  const std::uint16_t station;

 private:
  capi::Clock own_;

 public:
  capi::Clock& clock;  ///< its own, or that of its bus
  capi::Changes changes;
  capi::ChipEvents events;

  dpsim_change change_of(Tick at, PinNumber pin, Level level) const {
    return {static_cast<std::uint64_t>(at), station, pin, level, 0};
  }

 private:
  static constexpr std::size_t kMostPins = 64;
  struct Levels {
    Level low = 0;
    std::uint16_t count = 0;  ///< from `low` on; 0: it is not to be set
    bool has(Level level) const { return static_cast<std::uint16_t>(level - low) < count; }
  };
  std::array<Levels, kMostPins> levels_of(const capi::Kind& kind) const;
  [[noreturn]] void refuse(std::uint16_t number, Level level) const;

  std::array<Levels, kMostPins> levels_;  ///< by pin
};

// The DSDPV1 and its sisters as kinds of this library: the core alone, or the bench's chip on a segment.
#include <algorithm>

#include "capi/bus.hpp"
#include "capi/chip.hpp"
#include "capi/error.hpp"
#include "kinds/dsdpv1/chip/pin_chip.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/kind.hpp"
#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1::capi {
namespace {

using dsdpv1::Level;
using dsdpv1::Pin;
using tb::PinNumber;

constexpr std::uint16_t kCells = 0x800;  // P4

/// The core and nothing round it.
class Alone : public dpsim_chip {
 public:
  Alone(const Kind& its_kind, const dsdpv1::Config& config) : dpsim_chip(its_kind), chip_(config) {
    chip_.on_event(
        {[](void* self, const profibus::Event& event) { static_cast<Alone*>(self)->events.add(event); }, this});
  }

  void set(Tick at, PinNumber number, Level level) override {
    const auto pin = static_cast<Pin>(number);
    if (!is_watched(pin)) return chip_.set(at, pin, level);
    set_watched(at, pin, level);
  }
  void advance(Tick to) override { chip_.advance(to); }
  Tick hear(const bus::CharacterRun& run) override {
    const profibus::CharacterRun told{run.start, run.bit / profibus::kTicksPerCycle, run.bytes,
                                      static_cast<int>(std::min(run.size, kTooLong))};
    if (run.size == 0 || run.bit % profibus::kTicksPerCycle != 0 || is_watched(Pin::kPbrxd) || !line_is_idle() ||
        !chip_.hear(run.start, told))
      return kNotHeard;
    heard_ = &run;
    chip_.advance_in_run(run.end());
    heard_ = nullptr;
    if (chip_.left_run()) chip_.leave_run(chip_.now());
    return chip_.now();
  }
  Level sample(Tick at) override { return chip_.sample(at); }
  Tick next() override { return chip_.next_event(); }
  Tick now() const override { return chip_.now(); }
  Level level(PinNumber pin) const override {
    if (heard_ != nullptr && pin == kind.line_pin()) return heard_level();
    return chip_.level(static_cast<Pin>(pin));
  }
  void watch(tb::PinMask pins) override {
    watched_ = pins;
    sink_ = {changes.are_told() ? tell : keep, this};
    chip_.watch(sink_, pins);
  }
  tb::ChipStatus status() const override { return tb::status_of(chip_); }
  std::uint8_t peek(std::uint16_t address) const override { return chip_.peek(address); }
  void poke(std::uint16_t address, std::uint8_t value) override { chip_.poke(address, value); }
  std::vector<std::uint8_t> save() const override { return chip_.save(); }
  void restore(const std::uint8_t* bytes, std::size_t size) override {
    try {
      chip_.restore(bytes, size);
    } catch (const StateError& error) {
      fail(DPSIM_ERR_INPUT, error.what());
    }
  }

 private:
  static constexpr std::size_t kTooLong = 1 << 20;  ///< longer than any run that the core takes
  // From the core straight on to the caller's function, which nothing comes after: all that this library adds to a
  // change.
  static void tell(void* self, Tick at, Pin pin, Level level) {
    auto* own = static_cast<Alone*>(self);
    own->told_.tick = static_cast<std::uint64_t>(at);
    own->told_.pin = static_cast<PinNumber>(pin);
    own->told_.level = level;
    own->changes.tell_running(own->told_);
  }
  static void keep(void* self, Tick at, Pin pin, Level level) {
    auto* own = static_cast<Alone*>(self);
    own->changes.add(own->change_of(at, static_cast<PinNumber>(pin), level));
  }
  bool is_watched(Pin pin) const { return (watched_ & dsdpv1::mask(pin)) != 0; }
  bool line_is_idle() const { return chip_.level(Pin::kPbrxd) == 1; }
  /// In a callback: of the line before what changes at its own tick.
  Level heard_level() const {
    const Tick before = chip_.now() - 1;
    return before < heard_->start || heard_->level(before) ? 1 : 0;
  }
  [[gnu::noinline]] void set_watched(Tick at, Pin pin, Level level) {
    const Level before = chip_.level(pin);
    chip_.set(at, pin, level);
    if (level != before) sink_.call(sink_.self, at, pin, level);
  }

  dsdpv1::Chip chip_;
  tb::PinMask watched_ = 0;
  dsdpv1::PinSink sink_;
  dpsim_change told_ = change_of(0, 0, 0);
  const bus::CharacterRun* heard_ = nullptr;  ///< while it is
};

/// The bench's chip, whose user is the caller.
class OnBus : public dpsim_chip {
 public:
  OnBus(const Kind& its_kind, const ChipPlan& plan, dpsim_bus& its_bus)
      : dpsim_chip(its_kind, its_bus),
        device_(std::make_unique<tb::CoreDevice>(tb::config_of(plan.request()))),
        core_(device_->chip()),
        chip_(plan.name, std::move(device_), 0, its_bus.segment) {
    chip_.on_event = [this](const profibus::Event& event) { events.add(event); };
    chip_.on_pin = [this](Tick at, PinNumber pin, Level level) {
      if ((watched_ & tb::mask_of(pin)) != 0) changes.add(change_of(at, pin, level));
    };
    its_bus.timeline.add(chip_);
    its_bus.add_station({chip_.station(), Station::Kind::kChip});
  }

  void set(Tick at, PinNumber pin, Level level) override {
    bus->run(at);
    chip_.set_pin(at, static_cast<Pin>(pin), level);
  }
  void advance(Tick to) override { bus->run(to); }
  Level sample(Tick at) override {
    bus->run(at);
    return chip_.sample(at);
  }
  Tick next() override { return bus->timeline.next(); }
  Tick now() const override { return bus->timeline.now(); }
  Level level(PinNumber pin) const override { return chip_.level(pin); }
  void watch(tb::PinMask pins) override {
    watched_ = pins;
    chip_.watch(now(), pins);
  }
  tb::ChipStatus status() const override {
    catch_up();
    return chip_.status();
  }
  std::uint8_t peek(std::uint16_t address) const override {
    catch_up();
    return core_.peek(address);
  }
  void poke(std::uint16_t address, std::uint8_t value) override {
    chip_.sync(now());
    core_.poke(address, value);
  }
  std::vector<std::uint8_t> save() const override { refuse_state("saved"); }
  void restore(const std::uint8_t* /*bytes*/, std::size_t /*size*/) override { refuse_state("restored"); }

 private:
  [[noreturn]] static void refuse_state(const std::string& what) {
    fail(DPSIM_ERR_STATE, "the chip is on a bus, allowed is that one alone is " + what);
  }
  /// It leaves undone what nobody sees; inside of a callback it is not to be moved.
  void catch_up() const {
    if (!clock.calling) chip_.sync(now());
  }

  std::unique_ptr<tb::CoreDevice> device_;  ///< until chip_ has it
  dsdpv1::Chip& core_;
  mutable tb::PinChip chip_;
  tb::PinMask watched_ = 0;
};

class Dsdpv1 final : public Kind {
 public:
  Dsdpv1(const tb::ChipMaker& maker, Part part) : maker_(maker) {
    dsdpv1::Config config;
    config.part = part;
    const dsdpv1::Chip chip(config);
    for (int pin = 0; pin < pin_count(part); ++pin) reset_levels_.push_back(chip.level(static_cast<Pin>(pin)));
    parameters_ = parameters_of(*this);
  }
  const tb::ChipMaker& maker() const override { return maker_; }
  const std::vector<profibus::Reason>& reasons() const override {
    static const std::vector<profibus::Reason> all = dsdpv1::reasons();
    return all;
  }
  const std::vector<tb::Level>& reset_levels() const override { return reset_levels_; }
  std::uint16_t cells() const override { return kCells; }
  bool has_host_bus() const override { return true; }
  bool is_strap(const std::string& key) const override { return tb::is_strap(key); }
  const std::vector<Parameter>& parameters() const override { return parameters_; }
  PinNumber line_pin() const override { return static_cast<PinNumber>(Pin::kPbrxd); }
  std::unique_ptr<dpsim_chip> make_alone(const ChipPlan& plan) const override {
    return std::make_unique<Alone>(*this, tb::config_of(plan.request()));
  }
  std::unique_ptr<dpsim_chip> make_on_bus(const ChipPlan& plan, dpsim_bus& bus) const override {
    return std::make_unique<OnBus>(*this, plan, bus);
  }

 private:
  const tb::ChipMaker& maker_;
  std::vector<tb::Level> reset_levels_;
  std::vector<Parameter> parameters_;
};

}  // namespace

const Kind& dsdpv1_kind() {
  static const Dsdpv1 kind(tb::dsdpv1_kind(), Part::kDsdpv1);
  return kind;
}

const Kind& dsdpv1_r_kind() {
  static const Dsdpv1 kind(tb::dsdpv1_r_kind(), Part::kR);
  return kind;
}

const Kind& dsdpv1_rsu_kind() {
  static const Dsdpv1 kind(tb::dsdpv1_rsu_kind(), Part::kRsu);
  return kind;
}

}  // namespace dsdpv1::capi

#pragma once
// A chip of the kit as a device with pins: the station, its user's side and the port, evaluated edge by edge or from
// event to event.
#include <memory>
#include <vector>

#include "tb/chip/pin_device.hpp"
#include "tb/kit/slave_kit.hpp"

namespace dsdpv1::kit {

/// The device's blocks. Its members are those that profibus::whole_telegrams asks of a chip.
struct Core final : Chip {
  Core(const Parts& parts, const tb::OwnSettings& settings, bool step);

  // Chip
  void drive(Tick at, PinNumber pin, Level level) override;
  Level level(PinNumber pin) const override { return levels[pin]; }
  profibus::UserSide& user() override { return user_side; }
  const profibus::DpSlave& slave() const override { return station.slave(); }
  profibus::Station& dp_station() override { return station; }
  profibus::EventLog& events() override { return log; }
  void say(Cycle now_at, const profibus::ReasonRow& reason, unsigned a, unsigned b, unsigned c) override {
    log.at_cycle(now_at, profibus::Reason(reason), a, b, c);
  }
  const tb::OwnSettings& settings() const override { return own_settings; }

  void set(Tick at, PinNumber pin, Level level);
  void advance(Tick to);
  void evaluate(Tick event, Tick to);
  bool skips() const { return !step; }
  Tick next_event() const { return step ? (done + 1) * profibus::kTicksPerCycle : planned_edge; }
  void plan();
  void plan_station();
  void catch_up_line(Cycle upto) { station.catch_up(upto); }
  void hear(Tick at, bool level);
  void take_txd() { levels[kTxd] = txd(); }

  template <class Archive>
  void store(Archive& archive);
  void take_over(const Core& observed);

  void set_reset(Tick at, bool high);
  void reset(Tick at);
  void rising_edge(Cycle cycle);
  Level txd() const { return running && !station.txd() ? Level{0} : Level{1}; }

  const Parts& parts;
  const tb::OwnSettings& own_settings;
  const bool step;
  profibus::EventLog log;
  profibus::UserSide user_side;
  profibus::Station station;  // the times are its defaults
  std::vector<Level> levels;
  std::unique_ptr<UserPort> port;

  tb::PinSink sink;
  tb::PinMask watched = 0;
  Tick now = 0;
  Cycle done = 0;  // the last evaluated rising edge
  Tick planned_edge = profibus::kNever;
  Cycle other_plans = profibus::kNever;  // the earliest but the station's
  Cycle release_at = profibus::kNever;
  bool running = false;
};

class Device : public tb::PinDevice {
 public:
  Device(const Parts& parts, const tb::ChipRequest& request)
      : core_(std::make_unique<Core>(parts, request.settings, request.engine == tb::Engine::kStep || request.inside)) {}

  void set(Tick at, PinNumber pin, Level level) override { core_->set(at, pin, level); }
  void advance(Tick to) override { core_->advance(to); }
  Tick now() const override { return core_->now; }
  Tick next_event() const override { return core_->next_event(); }
  Level level(PinNumber pin) const override { return core_->level(pin); }
  Level sample(Tick /*at*/) override { return kReleased; }
  void watch(const tb::PinSink& sink, tb::PinMask pins) override;
  void on_event(const profibus::EventSink& sink) override { core_->log.attach(sink); }

  profibus::Unheard unheard() const override { return core_->station.unheard(); }
  void hear(Tick at, bool level) override { core_->hear(at, level); }
  bool hear(Tick at, const profibus::CharacterRun& run) override;
  void leave_run(Tick at) override;
  bool left_run() const override { return core_->station.left_run(); }
  void advance_in_run(Tick to) override;
  profibus::Unconcerned unconcerned() const override;
  void pass(std::uint64_t count) override { core_->station.pass(count); }
  bool begins_to_send() const override;
  profibus::CharacterRun hide_txd() override;
  void show_txd(Tick at) override;

  std::vector<std::uint8_t> save() const override;
  void restore(const std::uint8_t* bytes, std::size_t size) override;
  tb::ChipStatus status() const override;
  std::uint8_t address() const override { return core_->station.slave().address(); }
  std::uint8_t peek(std::uint16_t /*address*/) const override { return 0; }
  void poke(std::uint16_t /*address*/, std::uint8_t /*value*/) override {}

 private:
  std::unique_ptr<Core> core_;
};

}  // namespace dsdpv1::kit

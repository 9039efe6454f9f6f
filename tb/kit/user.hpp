#pragma once
// The chip of a kind of the kit on the segment, and the user CPU at its pins.
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "tb/chip/user_cpu/fiber.hpp"
#include "tb/chip/user_cpu/program_inputs.hpp"
#include "tb/kit/slave_kit.hpp"

namespace dsdpv1::kit {

/// The chip's pins as its user CPU has them.
class OwnPins : public user_cpu::UserSide {
 public:
  virtual void set(Tick at, PinNumber pin, Level level) = 0;
  virtual Level level(PinNumber pin) const = 0;
  /// Called at each change of Parts::told, also while the chip runs ahead of its user.
  std::function<void(Tick at, PinNumber pin, Level level)> on_change;
};

class OnSegment : public tb::PinChip, private OwnPins {
 public:
  OnSegment(const Kind& kind, const tb::ChipRequest& request, std::unique_ptr<tb::PinDevice> device,
            bus::Segment& segment)
      : PinChip(request.name, std::move(device), kind.pins(), kind.board_pins(), request.watched, segment),
        parts_(kind.made_of()) {}

  void set_reset(Tick at, bool level) override { set(at, kReset, level ? 1 : 0); }
  void reset_host(Tick at) override;
  bool is_in_users_turn() const override { return in_users_turn_; }
  user_cpu::UserSide* user_side() override { return static_cast<OwnPins*>(this); }

 private:
  void set(Tick at, PinNumber pin, Level level) override;
  Level level(PinNumber pin) const override { return PinChip::level(pin); }
  void host_pin_changed(Tick at, PinNumber pin, Level level) override {
    if (on_change) on_change(at, pin, level);
  }

  const Parts& parts_;
  bool in_users_turn_ = false;
};

/// Runs the program of a kind; each wait that others act in is a turn of the bench.
class Program : public user_cpu::StationCpu, private Cpu {
 public:
  /// All references must outlive it.
  Program(const Parts& parts, OwnPins& pins, const tb::OwnSettings& settings, const tb::OwnSettings& chip,
          const user_cpu::ProgramOptions& options, Tick start);
  ~Program() override { pins_.on_change = nullptr; }

  // user_cpu::StationCpu
  Tick next() const override;
  void run(Tick now) override;
  void interrupt_changed(Tick at, bool level) override;
  void command(Tick now, const user_cpu::Command& command) override;
  user_cpu::UserCounters counters() const override { return counters_; }
  std::uint64_t outputs_received() const override { return counters_.program->outputs_received; }
  const std::vector<std::uint8_t>& outputs() const override { return outputs_; }

 private:
  // Cpu
  const user_cpu::StationConfig& station() const override { return options_.station; }
  Tick period() const override { return options_.period; }
  const tb::OwnSettings& settings() const override { return settings_; }
  const tb::OwnSettings& chip_settings() const override { return chip_settings_; }
  Tick now() const override { return now_; }
  void wait_until(Tick at) override;
  bool wait_interrupt(Tick until) override;
  void on_change(std::function<void(Tick, PinNumber, Level)> hear) override { hear_ = std::move(hear); }
  void wait_change(Tick until) override;
  void set(PinNumber pin, Level level) override { pins_.set(now_, pin, level); }
  Level level(PinNumber pin) const override { return pins_.level(pin); }
  std::vector<std::uint8_t> inputs(std::size_t length) override;
  std::optional<Diagnosis> diagnosis() override { return std::exchange(diagnosis_, std::nullopt); }
  std::optional<user_cpu::command::OfChip> order() override;
  const user_cpu::AcyclicOptions& acyclic() const override { return options_.acyclic; }
  void received(std::vector<std::uint8_t> outputs) override;
  void written() override;
  void initialised() override { ++counters_.program->initialisations; }
  void failed(const std::string& code, const std::string& text) override;

  void pin_changed(Tick at, PinNumber pin, Level level);
  void begin(Tick at);
  void carry_out(const user_cpu::command::SetInputs& set) { inputs_.set(set.bytes); }
  void carry_out(const user_cpu::command::SetDiagnosis& set);
  void carry_out(const user_cpu::command::Reinitialise& again);
  void carry_out(const user_cpu::command::SetAnswering& set) { options_.acyclic.answering = set.answering; }
  void carry_out(const user_cpu::command::OfChip& order) { orders_.push_back(order); }
  void carry_out(const user_cpu::command::Stop&) { stopped_ = true; }
  void carry_out(const user_cpu::command::Resume&) { stopped_ = false; }
  template <class Refused>
  void carry_out(const Refused&) {}  // Kind::check_slave refuses it

  const Parts& parts_;
  OwnPins& pins_;
  const tb::OwnSettings& settings_;
  const tb::OwnSettings& chip_settings_;
  user_cpu::ProgramOptions options_;
  user_cpu::ProgramInputs inputs_{options_};
  user_cpu::UserCounters counters_;
  std::vector<std::uint8_t> outputs_;
  std::optional<Diagnosis> diagnosis_;
  std::deque<user_cpu::command::OfChip> orders_;
  Tick now_ = 0, due_ = 0;
  Tick interrupt_at_ = bus::kNever;  ///< the pin has left its level of rest, which wait_interrupt has not told yet
  bool waits_interrupt_ = false, waits_change_ = false, stopped_ = false;
  std::function<void(Tick, PinNumber, Level)> hear_;
  std::unique_ptr<user_cpu::Fiber> fiber_;
};

}  // namespace dsdpv1::kit

#pragma once
// What stands behind a chip's pins on the bench: the core, or RTL (cosim/).
#include "model/dsdpv1/chip.hpp"
#include "tb/chip/host_pins.hpp"

namespace dsdpv1::tb {

class PinDevice : public user_cpu::HostPins {
 public:
  virtual dsdpv1::Tick next_event() const = 0;
  /// See dsdpv1::Chip::unheard.
  virtual profibus::Unheard unheard() const { return {}; }
  /// See dsdpv1::Chip::hear; of a device that hears all, a change as any other.
  virtual void hear(dsdpv1::Tick at, bool level) { set(at, dsdpv1::Pin::kPbrxd, level ? 1 : 0); }
  /// See dsdpv1::Chip::hear, leave_run and left_run; a device that hears all takes no run.
  virtual bool hear(dsdpv1::Tick /*at*/, const profibus::CharacterRun& /*run*/) { return false; }
  virtual void leave_run(dsdpv1::Tick /*at*/) {}
  /// See dsdpv1::Chip::unconcerned and pass; a device that hears all is concerned by each run.
  virtual profibus::Unconcerned unconcerned() const { return {}; }
  virtual void pass(std::uint64_t /*count*/) {}
  virtual bool left_run() const { return false; }
  /// See dsdpv1::Chip::begins_to_send, hide_txd and show_txd; a device that shows all never says that it begins.
  virtual bool begins_to_send() const { return false; }
  virtual profibus::CharacterRun hide_txd() { return {}; }
  virtual void show_txd(dsdpv1::Tick /*at*/) {}
  virtual void watch(const dsdpv1::PinSink& sink, std::uint32_t pins) = 0;
  virtual void on_event(const profibus::EventSink& sink) = 0;
  /// The core that tells states, counters and events; the device itself, or one beside it on the same inputs.
  virtual const dsdpv1::Chip& core() const = 0;
};

/// The core itself.
class CoreDevice : public PinDevice {
 public:
  explicit CoreDevice(const dsdpv1::Config& config) : chip_(config) {}
  void set(dsdpv1::Tick at, dsdpv1::Pin pin, dsdpv1::Level level) override { chip_.set(at, pin, level); }
  void advance(dsdpv1::Tick to) override { chip_.advance(to); }
  dsdpv1::Level level(dsdpv1::Pin pin) const override { return chip_.level(pin); }
  dsdpv1::Level sample(dsdpv1::Tick at) override { return chip_.sample(at); }
  dsdpv1::Tick next_event() const override { return chip_.next_seen(); }
  profibus::Unheard unheard() const override { return chip_.unheard(); }
  void hear(dsdpv1::Tick at, bool level) override { chip_.hear(at, level); }
  bool hear(dsdpv1::Tick at, const profibus::CharacterRun& run) override { return chip_.hear(at, run); }
  void leave_run(dsdpv1::Tick at) override { chip_.leave_run(at); }
  profibus::Unconcerned unconcerned() const override { return chip_.unconcerned(); }
  void pass(std::uint64_t count) override { chip_.pass(count); }
  bool left_run() const override { return chip_.left_run(); }
  bool carry_out(dsdpv1::Tick begin, const dsdpv1::HostAccess& access, dsdpv1::Level& sampled) override {
    return chip_.carry_out(begin, access, sampled);
  }
  bool is_private(dsdpv1::Tick begin, const dsdpv1::HostAccess& access) override {
    return chip_.is_private(begin, access);
  }
  bool begins_to_send() const override { return chip_.begins_to_send(); }
  profibus::CharacterRun hide_txd() override { return chip_.hide_txd(); }
  void show_txd(dsdpv1::Tick at) override { chip_.show_txd(at); }
  void watch(const dsdpv1::PinSink& sink, std::uint32_t pins) override { chip_.watch(sink, pins); }
  void on_event(const profibus::EventSink& sink) override { chip_.on_event(sink); }
  const dsdpv1::Chip& core() const override { return chip_; }
  dsdpv1::Chip& chip() { return chip_; }

 private:
  dsdpv1::Chip chip_;
};

}  // namespace dsdpv1::tb

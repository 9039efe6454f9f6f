#pragma once
// The core of a DSDPV1 as a device with numbered pins: the enumerators of dsdpv1::Pin.
#include <vector>

#include "kinds/dsdpv1/pins/inside_watch.hpp"
#include "model/dsdpv1/chip.hpp"
#include "tb/chip/pin_device.hpp"

namespace dsdpv1::tb {

/// The core's status in the bench's format.
ChipStatus status_of(const dsdpv1::Chip& core);

class CoreDevice : public PinDevice {
 public:
  explicit CoreDevice(const dsdpv1::Config& config) : chip_(config) {}

  void set(Tick at, PinNumber pin, Level level) override { chip_.set(at, static_cast<dsdpv1::Pin>(pin), level); }
  void advance(Tick to) override { chip_.advance(to); }
  Tick now() const override { return chip_.now(); }
  Tick next_event() const override { return chip_.next_event(); }
  Tick next_seen() const override { return chip_.next_seen(); }
  Level level(PinNumber pin) const override { return chip_.level(static_cast<dsdpv1::Pin>(pin)); }
  Level sample(Tick at) override { return chip_.sample(at); }
  void watch(const PinSink& sink, PinMask pins) override { watch(sink, pins, false); }
  void watch_late(const PinSink& sink, PinMask pins) override { watch(sink, pins, true); }
  void on_event(const profibus::EventSink& sink) override { chip_.on_event(sink); }

  profibus::Unheard unheard() const override { return chip_.unheard(); }
  void hear(Tick at, bool level) override { chip_.hear(at, level); }
  bool hear(Tick at, const profibus::CharacterRun& run) override { return chip_.hear(at, run); }
  void leave_run(Tick at) override { chip_.leave_run(at); }
  bool left_run() const override { return chip_.left_run(); }
  void advance_in_run(Tick to) override { chip_.advance_in_run(to); }
  profibus::Unconcerned unconcerned() const override { return chip_.unconcerned(); }
  void pass(std::uint64_t count) override { chip_.pass(count); }
  bool begins_to_send() const override { return chip_.begins_to_send(); }
  profibus::CharacterRun hide_txd() override { return chip_.hide_txd(); }
  void show_txd(Tick at) override { chip_.show_txd(at); }

  ChipStatus status() const override { return status_of(chip_); }
  std::uint8_t address() const override { return chip_.address(); }
  std::uint8_t peek(std::uint16_t address) const override { return chip_.peek(address); }
  void poke(std::uint16_t address, std::uint8_t value) override { chip_.poke(address, value); }
  void look_inside(Tick now, std::size_t number, ChipListener& listener) override {
    inside_.look(now, chip_, number, listener);
  }
  const char* works_on() const override { return chip_.inside().access.item; }

  std::vector<std::uint8_t> save() const override { return chip_.save(); }
  void restore(const std::uint8_t* bytes, std::size_t size) override { chip_.restore(bytes, size); }

  dsdpv1::Chip& chip() { return chip_; }
  const dsdpv1::Chip& chip() const { return chip_; }

 private:
  void watch(const PinSink& sink, PinMask pins, bool late);

  dsdpv1::Chip chip_;
  PinSink sink_;
  InsideWatch inside_;
};

}  // namespace dsdpv1::tb

#pragma once
// A chip of the SPC3 family on the segment: its core as a device with numbered pins, the enumerators of spc3::Pin, its
// wiring on a board, and its bus for the user CPU.
#include <algorithm>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "kinds/spc3/inside_watch.hpp"
#include "kinds/spc3/user_cpu/bus_cycle.hpp"
#include "model/spc3/chip.hpp"
#include "tb/chip/pin_chip.hpp"
#include "tb/chip/user_cpu/register_port.hpp"

namespace dsdpv1::tb {

/// AB11 and the pins of SPI are only a VPC3+'s.
const PinTable& spc3_pins(spc3::Variant variant);
extern const BoardPins kSpc3BoardPins;

class Spc3Device : public PinDevice, private RegisterPort {
 public:
  explicit Spc3Device(const spc3::Config& config) : chip_(config) {}

  void set(Tick at, PinNumber pin, Level level) override {
    advance(at);
    chip_.set(at, static_cast<spc3::Pin>(pin), level);
  }
  void advance(Tick to) override;
  Tick now() const override { return chip_.now(); }
  Tick next_event() const override {
    return events_.empty() ? chip_.next_event() : std::min(events_.front().at, chip_.next_event());
  }
  Level level(PinNumber pin) const override { return chip_.level(static_cast<spc3::Pin>(pin)); }
  Level sample(Tick at) override {
    advance(at);
    return chip_.sample(at);
  }
  void watch(const PinSink& sink, PinMask pins) override;
  void on_event(const profibus::EventSink& sink) override;
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

  ChipStatus status() const override { return common_status(chip_.status()); }
  std::uint8_t address() const override { return chip_.address(); }
  std::uint8_t peek(std::uint16_t address) const override { return chip_.peek(address); }
  void poke(std::uint16_t address, std::uint8_t value) override { chip_.poke(address, value); }
  RegisterPort* registers() override { return this; }
  void look_inside(Tick now, std::size_t number, ChipListener& listener) override {
    inside_.look(now, chip_, number, listener);
  }

  std::vector<std::uint8_t> save() const override { return chip_.save(); }
  void restore(const std::uint8_t* bytes, std::size_t size) override { chip_.restore(bytes, size); }

 private:
  void told(const profibus::Event& event);
  std::uint8_t load(Tick at, std::uint16_t address) override {
    advance(at);
    return chip_.load(at / profibus::kTicksPerCycle, address);
  }
  void store(Tick at, std::uint16_t address, std::uint8_t value) override {
    advance(at);
    chip_.store(at / profibus::kTicksPerCycle, address, value);
  }

  spc3::Chip chip_;
  PinSink sink_;
  profibus::EventSink event_sink_;
  std::deque<profibus::Event> events_;  ///< of accesses, which the chip tells before the edge that takes them (A16)
  Spc3Inside inside_;
};

class Spc3PinChip : public PinChip, private user_cpu::HostBus {
 public:
  /// `bus`: the straps of the board.
  Spc3PinChip(const std::string& name, std::unique_ptr<PinDevice> device, const spc3::Config& config, spc3::Bus bus,
              PinMask watched, bus::Segment& segment, bool late);

  /// RESET is high-active.
  void set_reset(Tick at, bool released) override { PinChip::set_reset(at, !released); }
  void reset_host(Tick at) override;
  user_cpu::UserSide* user_side() override { return static_cast<user_cpu::HostBus*>(this); }

 private:
  void report(Tick at) { report_host(at, spc3::number(spc3::Pin::kXCs), spc3::number(spc3::Pin::kDbIn)); }
  void tell_access(Tick at);
  bool is_high(Tick at, spc3::Pin pin);

  // user_cpu::HostBus
  bool intr0(Tick at) override { return is_high(at, spc3::Pin::kXInt); }
  unsigned lamps(Tick at) override { return is_high(at, spc3::Pin::kXDataExch) ? 1 : 0; }
  bool is_used_from_anywhere() const override { return true; }
  void set_wait(const user_cpu::WaitTiming& wait) override { cycle_.set_wait(wait); }
  void begin(Tick at, const user_cpu::Access& access, const AccessTiming& timing) override {
    cycle_.begin(at, access, timing);
  }
  Tick next_edge() const override { return cycle_.next_edge(); }
  void run_edges(Tick until) override;
  Tick end() const override { return cycle_.end(); }
  std::uint8_t read_value() const override { return cycle_.read_value(); }
  bool last_read_was_bad() const override { return cycle_.last_read_was_bad(); }
  void set_serial(Tick at, dsdpv1::Pin pin, bool level) override;
  bool miso(Tick at) override;
  bool sck_rests_high() const { return (spi_mode_ & 2U) != 0; }
  void idle_serial(Tick at);
  void move_serial(Tick at, spc3::Pin pin, bool level);

  spc3_user::BusCycle cycle_;
  const bool has_spi_;
  const unsigned spi_mode_;
};

}  // namespace dsdpv1::tb

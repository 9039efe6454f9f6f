#pragma once
// A mailbox on a segment, as the bench has it. Keeps the changes of its outputs, and its events.
#include <cstddef>
#include <deque>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "tb/scenario/scenario.hpp"
#include "tests/mailbox/kind.hpp"
#include "tests/mailbox/reasons.hpp"

namespace dsdpv1::mailbox {

using tb::Engine;

class Board : private tb::ChipListener {
 public:
  Board(bus::Segment& segment, bus::Timeline& timeline, Engine engine) {
    tb::ChipRequest request{"mailbox", *settings_, engine};
    request.watched = tb::outputs_of(kind().pins());
    chip_ = kind().make_pin_chip(request, kind().make_device(request), segment);
    chip_->listen(*this, 0);
    timeline.add(*chip_);
  }

  tb::PinChip& chip() { return *chip_; }
  /// After all that has happened up to now.
  tb::ChipStatus status() const { return chip_->status(); }
  const std::vector<tb::PinEdge>& pin_changes() const { return pin_changes_; }
  const std::vector<profibus::Event>& events() const { return events_; }
  std::size_t count(profibus::Reason reason) const {
    std::size_t found = 0;
    for (const profibus::Event& event : events_) found += event.reason == reason ? 1 : 0;
    return found;
  }
  std::size_t count(PinNumber pin, Level level) const {
    std::size_t found = 0;
    for (const tb::PinEdge& change : pin_changes_) found += change.pin == pin && change.level == level ? 1 : 0;
    return found;
  }

  void set(Tick at, PinNumber pin, Level level) { chip_->set_pin(at, pin, level); }
  Level level(PinNumber pin) const { return chip_->level(pin); }

 private:
  void pin(std::size_t /*slave*/, Tick at, PinNumber pin, Level level) override {
    pin_changes_.push_back({at, pin, level});
  }
  void event(std::size_t /*slave*/, const profibus::Event& event) override { events_.push_back(event); }

  std::unique_ptr<tb::OwnSettings> settings_ = kind().make_chip_settings();
  std::unique_ptr<tb::PinChip> chip_;
  std::vector<tb::PinEdge> pin_changes_;
  std::vector<profibus::Event> events_;
};

/// The user CPU with its firmware, from `start` on.
struct UserConfig {
  Tick period = 100 * bus::kTicksPerUs;
  Tick sck_period = UserSettings().sck_period;
  std::uint8_t address = 5;
  std::uint16_t ident = 0x0B0C;
};

inline std::unique_ptr<user_cpu::StationCpu> make_user(tb::PinChip& chip, const UserConfig& config) {
  auto own = std::make_shared<UserSettings>();
  own->sck_period = config.sck_period;
  static std::deque<tb::scenario::Slave> slaves;  // each program keeps its settings
  tb::scenario::Slave& slave = slaves.emplace_back();
  slave.user_cpu.own = own;
  slave.user_cpu.cycle = config.period;
  slave.chip = kind().make_chip_settings();
  tb::scenario::Scenario scenario;
  std::set<const void*> left_out;
  user_cpu::StationConfig station;
  station.address = config.address;
  station.ident = config.ident;
  return kind().make_user({scenario, slave, chip, nullptr, left_out})(station, 0);
}

}  // namespace dsdpv1::mailbox

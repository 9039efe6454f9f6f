#pragma once
// A mailbox on a segment: PBRTS enables the driver, PBTXD is its input, PBRXD always hears the line. Keeps the chip's
// outputs and events.
#include <cstddef>
#include <string>
#include <vector>

#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "tb/chip/line_driver.hpp"
#include "tests/mailbox/chip.hpp"
#include "tests/mailbox/reasons.hpp"
#include "tests/mailbox/user.hpp"

namespace dsdpv1::mailbox {

struct PinChange {
  Tick at;
  Pin pin;
  Level level;
};
inline bool operator==(const PinChange& a, const PinChange& b) {
  return a.at == b.at && a.pin == b.pin && a.level == b.level;
}

class Board : public bus::Agent, public SpiPins, private bus::Listener {
 public:
  Board(bus::Segment& segment, Engine engine) : chip_({engine}), line_(segment, segment.attach("mailbox", this)) {
    chip_.watch({&on_pin, this}, kOutputPins);
    chip_.on_event({&on_event, this});
  }

  const Chip& chip() const { return chip_; }
  const std::vector<PinChange>& pin_changes() const { return pin_changes_; }
  const std::vector<profibus::Event>& events() const { return events_; }
  std::size_t count(profibus::Reason reason) const {
    std::size_t found = 0;
    for (const profibus::Event& event : events_) found += event.reason == reason ? 1 : 0;
    return found;
  }
  std::size_t count(Pin pin, Level level) const {
    std::size_t found = 0;
    for (const PinChange& change : pin_changes_) found += change.pin == pin && change.level == level ? 1 : 0;
    return found;
  }

  void set(Tick at, Pin pin, Level level) override {
    announce();
    chip_.set(at, pin, level);
  }
  Level level(Pin pin) const override { return chip_.level(pin); }

  Tick next() const override { return line_.waits() ? line_.since() : chip_.next_event(); }
  void run(Tick now) override {
    chip_.advance(now);
    line_.pass_on();
  }

 private:
  void line_changed(Tick at, bool level) override { set(at, Pin::kPbrxd, level ? 1 : 0); }

  static void on_pin(void* self, Tick at, Pin pin, Level level) {
    auto& board = *static_cast<Board*>(self);
    board.pin_changes_.push_back({at, pin, level});
    if (pin == Pin::kPbtxd) board.line_.drive(at, level != 0);
    if (pin == Pin::kPbrts) board.line_.enable(at, level != 0);
  }
  static void on_event(void* self, const profibus::Event& event) {
    static_cast<Board*>(self)->events_.push_back(event);
  }

  Chip chip_;
  tb::LineDriver line_;
  std::vector<PinChange> pin_changes_;
  std::vector<profibus::Event> events_;
};

}  // namespace dsdpv1::mailbox

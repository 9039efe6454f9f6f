// The inputs of a chip as a stimulus: played, it gives the same ones at the same ticks.
#include "cosim/random/recorded_stimulus.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "cosim/random/campaign.hpp"
#include "kinds/dsdpv1/kind.hpp"
#include "tests/cosim/played.hpp"

namespace dsdpv1::cosim {

bool operator==(const InputChange& a, const InputChange& b) {
  return a.at == b.at && a.pin == b.pin && a.level == b.level;
}

namespace {

/// As Lockstep keeps them.
class InputsOf : public PlayListener {
 public:
  explicit InputsOf(const tb::ChipKind& kind) : places_(kind.board_pins()) {}

  void begins(const tb::PinDevice& both) override { chip_ = &both; }
  void pin(Tick at, Side side, PinNumber pin, Level level) override {
    if (side != Side::kInput) return;
    if (pin == places_.rxd) {
      if (chip_->level(places_.rts) != 0 || (level != 0 && !low_)) return;
      low_ = level == 0;
    }
    changes.push_back({at, pin, level});
  }
  std::vector<InputChange> changes;

 private:
  const tb::BoardPins& places_;
  bool low_ = false;
  const tb::PinDevice* chip_ = nullptr;
};

/// In order of time; what happens at one tick in any order.
std::vector<InputChange> inputs_of(const Stimulus& stimulus, PlayOptions options) {
  InputsOf inputs(*options.kind);
  options.listeners = {&inputs};
  EXPECT_FALSE(play(stimulus, reference_top(options, 0, 1), options).difference);
  std::stable_sort(inputs.changes.begin(), inputs.changes.end(), [](const InputChange& a, const InputChange& b) {
    return a.at != b.at ? a.at < b.at : a.pin < b.pin;
  });
  return std::move(inputs.changes);
}

struct Port {
  const char* name;
  Part part;
  std::vector<std::string> mode;
};

class RecordedStimulus : public testing::TestWithParam<Port> {};

TEST_P(RecordedStimulus, OfARandomCaseGivesTheSameInputs) {
  PlayOptions options = quick_options(tb::kind_of(GetParam().part));
  set_parameters(options, GetParam().mode);
  for (std::uint64_t number : {7U, 8U, 9U}) {
    const std::vector<InputChange> first = inputs_of(random_case(case_seed(3, number), options), options);
    const Tick end = first.back().at;
    std::vector<InputChange> again = inputs_of(recorded_stimulus(first, end, *options.kind), options);
    while (!again.empty() && again.back().at > end) again.pop_back();
    EXPECT_EQ(first.size(), again.size());
    const auto [one, other] = std::mismatch(first.begin(), first.end(), again.begin(), again.end());
    EXPECT_TRUE(one == first.end()) << number << ": " << options.kind->pins()[one->pin].name << " at " << one->at;
    EXPECT_TRUE(other == again.end());
  }
}

INSTANTIATE_TEST_SUITE_P(All, RecordedStimulus,
                         testing::Values(Port{"dsdpv1", Part::kDsdpv1, {}}, Port{"parallel", Part::kRsu, {}},
                                         Port{"spi", Part::kRsu, {"chip.mode=spi"}},
                                         Port{"uart", Part::kRsu, {"chip.mode=uart"}}),
                         [](const auto& each) { return std::string(each.param.name); });

/// A request, a write, and a low pulse too short for a character. The lanes meet before what the line carries.
TEST(RecordedStimulus, HasTelegramsPulsesAndAccesses) {
  const tb::ChipKind& kind = tb::kind_of(Part::kDsdpv1);
  std::vector<InputChange> changes = {{6541, number(Pin::kReset), 1}};
  constexpr Tick kBegin = 100'000, kBit = 1000;
  Tick at = kBegin;
  bool high = true;
  for (const bus::Character& each : bus::characters({0x10, 0x05, 0x02, 0x49, 0x50, 0x16}))
    for (int bit = 0; bit < each.bit_count; ++bit, at += kBit)
      if (const bool level = (each.bits >> bit & 1) != 0; level != std::exchange(high, level))
        changes.push_back({at, number(Pin::kPbrxd), static_cast<Level>(level)});
  changes.push_back({200'000, number(Pin::kA), 0x10});
  changes.push_back({200'000, number(Pin::kCsr), 0});
  changes.push_back({200'300, number(Pin::kWr), 0});
  changes.push_back({200'900, number(Pin::kWr), 1});
  changes.push_back({201'000, number(Pin::kCsr), 1});
  changes.push_back({250'000, number(Pin::kPbrxd), 0});
  changes.push_back({250'700, number(Pin::kPbrxd), 1});
  const std::string text = to_text(recorded_stimulus(changes, 260'000, kind), kind, {"chip.fcb_rule=content"});
  EXPECT_EQ(text.substr(text.find('\n') + 1),
            "set chip.fcb_rule=content\nalone\nreset +0 low=6541\nsync\n"
            "send +93459 rate=0 reply=0 : 10 05 02 49 50 16\n"
            "pin +193459 A level=16\npin +0 CSR level=0\npin +300 WR level=0\npin +600 WR level=1\n"
            "pin +100 CSR level=1\nsync\nspike +49000 low=700\npin +59000 RESET level=1\n");
  EXPECT_EQ(settings_in(text), std::vector<std::string>{"chip.fcb_rule=content"});
  EXPECT_EQ(to_text(parse_stimulus(text, "x", kind), kind, settings_in(text)), text);
}

}  // namespace
}  // namespace dsdpv1::cosim

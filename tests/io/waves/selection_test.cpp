// The parts of a run in its wave: patterns, windows, windows around events, CLK.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "io/input/input_error.hpp"
#include "io/waves/wave_selection.hpp"

namespace dsdpv1 {
namespace {

using Lines = std::vector<std::string>;

/// Records its calls.
class Notes : public tb::WaveWriter {
 public:
  explicit Notes(Lines& lines) : lines_(lines) {}
  void open_scope(const std::string& name) override { scope_ += name + "."; }
  void close_scope() override { scope_.clear(); }
  Signal wire(const std::string& name, int /*width*/) override { return words(name); }
  Signal words(const std::string& name) override {
    names_.push_back(scope_ + name);
    return static_cast<Signal>(names_.size() - 1);
  }
  void alias(const std::string& /*name*/, Signal /*of*/) override { FAIL(); }
  void set(bus::Tick at, Signal signal, int level) override { say(at, signal, std::to_string(level)); }
  void say(bus::Tick at, Signal signal, std::string_view word) override {
    EXPECT_GE(at, now_);
    now_ = at;
    lines_.push_back(fmt::format("{} {}={}", at, names_.at(signal), word));
  }
  void save(bus::Tick /*at*/) override {}
  bool failed() const override { return false; }
  void check() const override {}
  void finish(bus::Tick end) override { lines_.push_back(fmt::format("{} end", end)); }
  // The times of a run are ticks.
  void set(tb::Picoseconds /*at*/, Signal /*signal*/, std::string_view /*levels*/) override { FAIL(); }
  void say(tb::Picoseconds /*at*/, Signal /*signal*/, std::string_view /*word*/) override { FAIL(); }
  void finish(tb::Picoseconds /*end*/) override { FAIL(); }

 private:
  Lines& lines_;
  std::vector<std::string> names_;
  std::string scope_;
  bus::Tick now_ = 0;
};

/// Two signals of a chip: `level` and the words of `state`.
struct Example {
  Lines lines;
  tb::SelectedWave wave;
  tb::WaveWriter::Signal level, state;

  explicit Example(tb::WaveSelection selection) : wave(std::make_unique<Notes>(lines), std::move(selection)) {
    wave.open_scope("plc");
    level = wave.wire("LEVEL", 1);
    state = wave.words("state");
    wave.close_scope();
    wave.set(0, level, 0);
    wave.say(0, state, "off");
  }
};

tb::WaveSelection round_events(bus::Tick around) {
  tb::WaveSelection selection;
  selection.on_trigger = true;
  selection.around = around;
  return selection;
}

TEST(WaveSelection, PassesEverythingWhenNothingIsSelected) {
  Example run({});
  run.wave.set(5, run.level, 1);
  run.wave.finish(9);
  EXPECT_EQ(run.lines, Lines({"0 plc.LEVEL=0", "0 plc.state=off", "5 plc.LEVEL=1", "9 end"}));
}

TEST(WaveSelection, TakesSignalsThatFitOneOfThePatterns) {
  tb::WaveSelection selection;
  selection.signals = {"bus.*", "*.LEV?L"};
  Example run(selection);
  run.wave.say(5, run.state, "on");
  run.wave.finish(9);
  EXPECT_EQ(run.lines, Lines({"0 plc.LEVEL=0", "9 end"}));
}

TEST(WaveSelection, RefusesAPatternThatFitsNoSignalAndNamesThem) {
  tb::WaveSelection selection;
  selection.signals = {"*.LEVEL", "plc.stata"};
  Example run(selection);
  try {
    run.wave.check_patterns();
    FAIL() << "not refused";
  } catch (const tb::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "--wave-signals plc.stata fits no signal (did you mean plc.state?), expected patterns of "
                 "plc.LEVEL, plc.state");
  }
}

TEST(WaveSelection, AWindowBeginsWithTheValuesOfThenAndEndsTheFile) {
  tb::WaveSelection selection;
  selection.from = 10, selection.to = 20;
  Example run(selection);
  run.wave.set(4, run.level, 1);
  run.wave.set(10, run.level, 0);
  run.wave.say(20, run.state, "on");
  run.wave.say(21, run.state, "late");
  run.wave.finish(30);
  EXPECT_EQ(run.lines, Lines({"10 plc.LEVEL=1", "10 plc.state=off", "10 plc.LEVEL=0", "20 plc.state=on", "20 end"}));
  EXPECT_TRUE(run.wave.has_window());
}

TEST(WaveSelection, AWindowInWhichNothingChangesHasItsValuesToo) {
  tb::WaveSelection selection;
  selection.from = 10, selection.to = 20;
  Example run(selection);
  run.wave.finish(15);
  EXPECT_EQ(run.lines, Lines({"10 plc.LEVEL=0", "10 plc.state=off", "15 end"}));
  Example longer(selection);
  longer.wave.set(25, longer.level, 1);
  longer.wave.finish(30);
  EXPECT_EQ(longer.lines, Lines({"10 plc.LEVEL=0", "10 plc.state=off", "20 end"}));
}

TEST(WaveSelection, AWindowBehindTheEndOfTheRunIsUnknown) {
  tb::WaveSelection selection;
  selection.from = 100;
  Example run(selection);
  run.wave.finish(15);
  EXPECT_EQ(run.lines, Lines({"0 plc.LEVEL=-2", "0 plc.state=(not recorded)", "15 end"}));
  EXPECT_FALSE(run.wave.has_window());
}

TEST(WaveSelection, AnEventOpensAWindowThatBeganBeforeIt) {
  Example run(round_events(10));
  run.wave.set(100, run.level, 1);
  run.wave.set(108, run.level, 0);
  run.wave.trigger(115);
  run.wave.set(125, run.level, 1);
  run.wave.set(126, run.level, 0);
  run.wave.finish(200);
  EXPECT_EQ(run.lines, Lines({"105 plc.LEVEL=1", "105 plc.state=off", "108 plc.LEVEL=0", "125 plc.LEVEL=1",
                              "125 plc.LEVEL=-2", "125 plc.state=(not recorded)", "200 end"}));
}

TEST(WaveSelection, AnEventThatIsToldLateHasItsWindowInFull) {
  Example run(round_events(10));
  run.wave.set(100, run.level, 1);
  run.wave.set(150, run.level, 0);
  run.wave.trigger(109);
  run.wave.finish(200);
  EXPECT_EQ(run.lines.front(), "99 plc.LEVEL=0");
  EXPECT_EQ(run.lines.at(2), "100 plc.LEVEL=1");
}

TEST(WaveSelection, WindowsThatTouchAreOneAndOthersAreApart) {
  Example run(round_events(10));
  run.wave.trigger(50);
  run.wave.trigger(55);
  run.wave.set(64, run.level, 1);
  run.wave.set(80, run.level, 0);
  run.wave.trigger(81);
  run.wave.finish(85);
  EXPECT_EQ(run.lines,
            Lines({"40 plc.LEVEL=0", "40 plc.state=off", "64 plc.LEVEL=1", "65 plc.LEVEL=-2",
                   "65 plc.state=(not recorded)", "71 plc.LEVEL=1", "71 plc.state=off", "80 plc.LEVEL=0", "85 end"}));
}

TEST(WaveSelection, AWindowDoesNotReachIntoTheOneBeforeIt) {
  Example run(round_events(10));
  run.wave.trigger(50);
  run.wave.set(61, run.level, 1);
  run.wave.trigger(62);
  run.wave.finish(70);
  EXPECT_EQ(run.lines, Lines({"40 plc.LEVEL=0", "40 plc.state=off", "60 plc.LEVEL=-2", "60 plc.state=(not recorded)",
                              "61 plc.LEVEL=0", "61 plc.state=off", "61 plc.LEVEL=1", "70 end"}));
}

TEST(WaveSelection, WiresOnlyAreSingleOnesWithoutWords) {
  tb::WaveSelection selection;
  selection.wires_only = true;
  Lines lines;
  tb::SelectedWave wave(std::make_unique<Notes>(lines), selection);
  const auto bus = wave.wire("D", 3), state = wave.words("state"), single = wave.wire("CSR", 1);
  wave.set(1, bus, 5);
  wave.say(2, state, "on");
  wave.set(3, bus, tb::WaveWriter::kReleased);
  wave.set(4, single, 1);
  wave.finish(5);
  EXPECT_EQ(lines,
            Lines({"1 D[0]=1", "1 D[1]=0", "1 D[2]=1", "3 D[0]=-1", "3 D[1]=-1", "3 D[2]=-1", "4 CSR=1", "5 end"}));
}

TEST(WaveSelection, ClkRisesAtEveryCycleWithinTheWindowOnly) {
  tb::WaveSelection selection;
  selection.signals = {"plc.LEVEL"};
  selection.clock = true;
  selection.from = 260, selection.to = 600;
  Example run(selection);
  run.wave.set(500, run.level, 1);
  run.wave.set(700, run.level, 0);
  run.wave.finish(800);
  EXPECT_EQ(run.lines, Lines({"260 clock.CLK=1", "260 plc.LEVEL=0", "375 clock.CLK=0", "500 clock.CLK=1",
                              "500 plc.LEVEL=1", "600 end"}));
}

}  // namespace
}  // namespace dsdpv1

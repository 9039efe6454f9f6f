// The lockstep against RTL that differs in a known way: it must stop at the first difference and name it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <utility>

#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "bus/wire/uart.hpp"
#include "cosim/lockstep.hpp"
#include "kinds/dsdpv1/chip/core_device.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/kind.hpp"
#include "tb/bench/ruling_place.hpp"
#include "tests/cosim/made_up_top.hpp"

namespace dsdpv1 {
namespace {

using cosim_test::MadeUpTop;
using testing::HasSubstr;

constexpr Tick kCycle = profibus::kTicksPerCycle;
constexpr Tick kEnd = 10'000 * kCycle;

std::unique_ptr<MadeUpTop> spoiled(MadeUpTop::Spoil spoil) { return std::make_unique<MadeUpTop>(std::move(spoil)); }

const tb::Dsdpv1Settings kSettings;

struct Lockstep : cosim::Lockstep {
  explicit Lockstep(std::unique_ptr<MadeUpTop> top, const cosim::LockstepOptions& options = {})
      : cosim::Lockstep(std::make_unique<tb::CoreDevice>(dsdpv1::Config()), std::move(top), tb::kind_of(Part::kDsdpv1),
                        kSettings, options) {}
};

/// Out of RESET after 10 us, then to kEnd.
void run(Lockstep& lockstep) {
  lockstep.set(480 * kCycle + 40, number(Pin::kReset), 1);
  lockstep.advance(kEnd);
}

TEST(Lockstep, ModelAgainstItselfIsTheSame) {
  Lockstep lockstep(std::make_unique<MadeUpTop>());
  run(lockstep);
  ASSERT_FALSE(lockstep.difference()) << cosim::describe(*lockstep.difference());
  EXPECT_EQ(lockstep.counts().cycles, 10'000U);
  EXPECT_GT(lockstep.counts().pin_changes, 600U);  // L_REQ and L_STA each microsecond
  EXPECT_GT(lockstep.counts().dpram_images, 1U);
}

class EachPin : public testing::TestWithParam<Pin> {};

TEST_P(EachPin, ThatDiffersIsNamedWithCycleAndBothLevels) {
  const Pin pin = GetParam();
  Lockstep lockstep(spoiled([pin](Level* levels, long cycle) {
    if (cycle >= 5000) levels[number(pin)] ^= 1;
  }));
  run(lockstep);
  ASSERT_TRUE(lockstep.difference());
  EXPECT_EQ(lockstep.difference()->at, 5000 * kCycle);
  const int model = static_cast<int>(lockstep.difference()->what.find("model 1") != std::string::npos);
  EXPECT_EQ(lockstep.difference()->what,
            std::string("pin ") + dsdpv1::name(pin) + (model != 0 ? ": model 1, RTL 0" : ": model 0, RTL 1"));
  EXPECT_THAT(cosim::describe(*lockstep.difference()), HasSubstr("cycle 5000 (104.167 us)"));
  EXPECT_EQ(lockstep.counts().cycles, 5000U);
}

INSTANTIATE_TEST_SUITE_P(Outputs, EachPin,
                         testing::Values(Pin::kLReq, Pin::kLSta, Pin::kIntr0, Pin::kPbtxd, Pin::kPbrts, Pin::kPbf,
                                         Pin::kBr, Pin::kReady),
                         [](const auto& each) { return std::string(dsdpv1::name(each.param)); });

TEST(Lockstep, ADifferenceOfOneCycleIsFound) {
  Lockstep lockstep(spoiled([](Level* levels, long cycle) {
    if (cycle == 7777) levels[number(Pin::kIntr0)] ^= 1;
  }));
  run(lockstep);
  ASSERT_TRUE(lockstep.difference());
  EXPECT_EQ(lockstep.difference()->at, 7777 * kCycle);
}

TEST(Lockstep, DDrivenWithoutAReadIsFound) {
  Lockstep lockstep(spoiled([](Level* levels, long cycle) {
    if (cycle >= 6000) levels[number(Pin::kDOut)] = 0x3C;
  }));
  run(lockstep);
  ASSERT_TRUE(lockstep.difference());
  EXPECT_EQ(lockstep.difference()->what, "pin D_OUT: model Z, RTL 3C");
}

TEST(Lockstep, AnOutputThatIsUnknownIsADifference) {
  Lockstep lockstep(spoiled([](Level* levels, long cycle) {
    if (cycle >= 4000) levels[number(Pin::kPbrts)] = dsdpv1::kLevelX;
  }));
  run(lockstep);
  ASSERT_TRUE(lockstep.difference());
  EXPECT_EQ(lockstep.difference()->what, "pin PBRTS: model 0, RTL X");
}

/// READY_FLAG is the model's only event.
TEST(Lockstep, ADifferenceNamesTheModelsLastEventsAndTheRulingsOfPinAndEvents) {
  Lockstep lockstep(spoiled([](Level* levels, long cycle) {
    if (cycle >= 5000) levels[number(Pin::kIntr0)] = 0;
  }));
  run(lockstep);
  ASSERT_TRUE(lockstep.difference());
  EXPECT_THAT(lockstep.difference()->events, testing::ElementsAre(HasSubstr("READY_FLAG at cycle 4")));
  EXPECT_THAT(lockstep.difference()->rulings, testing::ElementsAre("P7", "H3", "H6", "T2-004"));
  EXPECT_THAT(cosim::describe(*lockstep.difference()), HasSubstr("see rulings       P7, H3, H6, T2-004\n"));
}

TEST(Lockstep, EachOutputHasRulingsThatThePagesHave) {
  std::string pages;
  for (const char* page : {"/docs/chip.md", "/docs/chip_rsu.md"}) {
    std::ifstream file(std::string(DSDPV1_SOURCE_DIR) + page);
    pages.append(std::istreambuf_iterator<char>(file), {});
  }
  for (const tb::PinInfo& pin : tb::kind_of(Part::kRsu).pins()) {
    EXPECT_EQ(tb::names_of(pin.rulings).empty(), pin.input) << pin.name;
    for (const std::string& name : tb::names_of(pin.rulings)) EXPECT_THAT(pages, HasSubstr("**" + name + "**<a id="));
  }
}

TEST(Lockstep, AnotherContentOfTheDpramIsFoundAtTheEndOfAnAccess) {
  auto top = std::make_unique<MadeUpTop>();
  top->spoil_cell(0x123);
  Lockstep lockstep(std::move(top));
  lockstep.set(480 * kCycle, number(Pin::kReset), 1);
  lockstep.advance(10 * kEnd);  // without writes: compared from time to time
  ASSERT_TRUE(lockstep.difference());
  EXPECT_EQ(lockstep.difference()->what, "DPRAM B123: model 00, RTL 5A");
  EXPECT_THAT(lockstep.difference()->dpram, HasSubstr("last access from cycle"));
}

TEST(Lockstep, ToleranceLetsAPinBeLater) {
  cosim::LockstepOptions options;
  options.tolerances.at(static_cast<std::size_t>(Pin::kLReq)) = 1;
  Level before = 0;
  const auto late = [&before](Level* levels, long) {  // L_REQ half a cycle late
    const Level now = levels[number(Pin::kLReq)];
    levels[number(Pin::kLReq)] = std::exchange(before, now);
  };
  Lockstep tolerant(spoiled(late), options);
  run(tolerant);
  EXPECT_FALSE(tolerant.difference()) << cosim::describe(*tolerant.difference());
  before = 0;
  Lockstep exact(spoiled(late));
  run(exact);
  ASSERT_TRUE(exact.difference());
  EXPECT_EQ(exact.difference()->what, "pin L_REQ: model 1, RTL 0");
}

TEST(Lockstep, WaveShowsBothSidesAroundTheDifference) {
  Lockstep lockstep(spoiled([](Level* levels, long cycle) {
    if (cycle >= 5000) levels[number(Pin::kReady)] = 1;
  }));
  run(lockstep);
  const auto file = std::filesystem::path(testing::TempDir()) / "lockstep_both_sides.vcd";
  lockstep.write_wave(file.string());
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  for (const char* scope : {"inputs", "model", "rtl"}) EXPECT_THAT(text, HasSubstr(std::string("module ") + scope));
  const auto count = [&text](const std::string& name) {
    std::size_t found = 0;
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count(" READY "), 2U);
  EXPECT_EQ(count(" RESET "), 1U);
  std::filesystem::remove(file);
}

TEST(Lockstep, LastTelegramAndAccessAreTold) {
  Lockstep lockstep(spoiled([](Level* levels, long cycle) {
    if (cycle >= 9000) levels[number(Pin::kBr)] ^= 1;
  }));
  lockstep.set(480 * kCycle, number(Pin::kReset), 1);
  bus::Segment segment;
  struct Line : bus::Listener {
    explicit Line(Lockstep& lockstep) : chip(lockstep) {}
    void line_changed(bus::Tick at, bool level) override { chip.set(at, number(Pin::kPbrxd), level ? 1 : 0); }
    Lockstep& chip;
  } line(lockstep);
  segment.attach("chip", &line);
  bus::UartSender sender(segment, segment.attach("master", nullptr));
  sender.set_timing(bus::baud(0).bit);
  sender.send(6000 * kCycle, bus::characters({0x10, 0x05, 0x02, 0x49, 0x50, 0x16}, {}));
  while (sender.busy()) sender.run(sender.next());
  lockstep.advance(kEnd);
  ASSERT_TRUE(lockstep.difference());
  EXPECT_THAT(lockstep.difference()->last_telegram, HasSubstr("10 05 02 49 50 16"));
  EXPECT_THAT(lockstep.difference()->last_telegram, HasSubstr("cycle 6000"));
  EXPECT_EQ(lockstep.difference()->last_access, "none");
}

}  // namespace
}  // namespace dsdpv1

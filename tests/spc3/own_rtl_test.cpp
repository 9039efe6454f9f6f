// RTL of the user's beside a chip of the SPC3 family: pins, timing and words of the lockstep. The RTL is the model,
// evaluated as RTL is, with one defect chosen by the test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cosim/lockstep.hpp"
#include "cosim/pin_map.hpp"
#include "kinds/spc3/chip.hpp"
#include "kinds/spc3/kind.hpp"
#include "kinds/spc3/settings.hpp"
#include "registers/spc3_regs.hpp"

namespace dsdpv1 {
namespace {

using bus::Tick;
using spc3::Pin;
using tb::Level;
using testing::HasSubstr;
namespace regs = spc3::regs;

const tb::Spc3Settings kSettings;
const tb::ChipKind& kind() { return tb::kind_of(spc3::Variant::kApc3); }

class ModelAsRtl : public cosim::Rtl {
 public:
  using Spoil = std::function<void(Level* levels, Tick at)>;
  explicit ModelAsRtl(Spoil spoil = {}) : spoil_(std::move(spoil)) {}

  void moment(Tick at) override { at_ = at; }
  void eval(bool /*clk*/, Level* levels) override {
    if (at_ < 0) resets_.push_back(levels[number(Pin::kReset)]);
    for (int i = 0; i < spc3::kPinCount && at_ >= 0; ++i)
      if (const auto pin = static_cast<Pin>(i); spc3::is_input(pin)) chip_.set(at_, pin, levels[i]);
    if (at_ >= 0) chip_.advance(at_);
    for (int i = 0; i < spc3::kPinCount; ++i)
      if (const auto pin = static_cast<Pin>(i); !spc3::is_input(pin)) levels[i] = chip_.level(pin);
    if (spoil_) spoil_(levels, at_);
  }
  /// RESET before time begins.
  const std::vector<Level>& resets() const { return resets_; }

 private:
  Spoil spoil_;
  spc3::Chip chip_;
  Tick at_ = -1;
  std::vector<Level> resets_;
};

struct Lockstep : cosim::Lockstep {
  explicit Lockstep(std::unique_ptr<ModelAsRtl> rtl)
      : cosim::Lockstep(std::make_unique<tb::Spc3Device>(spc3::Config()), std::move(rtl), kind(), kSettings, {}) {}
};

/// A CPU at the pins.
class User {
 public:
  explicit User(Lockstep& chip) : chip_(chip) {}

  void wait(Tick time) { chip_.advance(now_ += time); }
  void set(Pin pin, Level level) { chip_.set(now_, number(pin), level); }
  void write(int address, Level value) {
    set(Pin::kDbIn, value);
    access(Pin::kXWr, address, 2511);
    set(Pin::kDbIn, tb::kLevelZ);
    wait(1003);
  }
  Level read(int address) {
    access(Pin::kXRd, address, 2517);
    wait(1001);
    return sampled_;
  }
  void start() {
    wait(12'345);
    set(Pin::kReset, 0);
    wait(6'789);
  }

 private:
  void access(Pin strobe, int address, Tick low) {
    set(Pin::kAb, static_cast<Level>(address));
    set(Pin::kXCs, 0);
    set(strobe, 0);
    wait(low);
    sampled_ = chip_.sample(now_);
    set(strobe, 1);
    set(Pin::kXCs, 1);
  }
  Lockstep& chip_;
  Tick now_ = 0;
  Level sampled_ = 0;
};

/// Registers, RAM and an interrupt; the last byte read.
Level use(Lockstep& chip) {
  User user(chip);
  user.start();
  user.write(regs::kOrgAddress, 9);
  user.write(regs::kMode0 + 1, 0x01);
  user.write(regs::kImr, 0xFE);
  user.write(regs::kIrr, 0x01);  // X/INT falls
  user.write(regs::kMode1S, regs::kMode1Start | regs::kMode1Eoi);
  return user.read(regs::kOrgAddress);
}

TEST(OwnRtlOfAnSpc3, TheModelAsRtlIsTheSame) {
  auto rtl = std::make_unique<ModelAsRtl>(
      [](Level* levels, Tick /*at*/) { levels[number(Pin::kClkOut)] = 0; });  // A43: the model does not know it
  const ModelAsRtl& own = *rtl;
  Lockstep chip(std::move(rtl));
  EXPECT_EQ(use(chip), 9);
  ASSERT_FALSE(chip.difference()) << cosim::describe(*chip.difference());
  EXPECT_GT(chip.counts().pin_changes, 14U);  // XREADY and DB of six accesses, X/INT
  EXPECT_EQ(own.resets().front(), 0);         // RESET is high-active: it has had its edge
  EXPECT_EQ(own.resets().back(), 1);
}

TEST(OwnRtlOfAnSpc3, ConstantOutputsDifferAtTheFirstChange) {
  Lockstep chip(std::make_unique<ModelAsRtl>([](Level* levels, Tick /*at*/) {
    for (int i = 0; i < spc3::kPinCount; ++i)
      if (const auto& row = spc3::kPinRows[i]; row.direction == spc3::Direction::kOutput) levels[i] = row.level;
  }));
  use(chip);
  ASSERT_TRUE(chip.difference());
  EXPECT_EQ(chip.difference()->what, "pin XREADY_XDTACK: model 0, RTL 1");
  const Tick strobe = 12'345 + 6'789;
  EXPECT_EQ(chip.difference()->at, (strobe / bus::kTicksPerCycle + 1 + kSettings.ready) * bus::kTicksPerCycle);  // A42
  EXPECT_THAT(chip.difference()->rulings, testing::Contains("A42"));
}

TEST(OwnRtlOfAnSpc3, AnInterruptACycleLateIsFound) {
  Tick fell = 0;
  Lockstep chip(std::make_unique<ModelAsRtl>([&fell](Level* levels, Tick at) {
    Level& x_int = levels[number(Pin::kXInt)];
    if (x_int == 0 && fell == 0) fell = at;
    if (x_int == 0 && at < fell + bus::kTicksPerCycle) x_int = 1;
  }));
  use(chip);
  ASSERT_TRUE(chip.difference());
  EXPECT_EQ(chip.difference()->what, "pin X_INT: model 0, RTL 1");
  EXPECT_EQ(chip.difference()->at, fell);
  EXPECT_THAT(cosim::describe(*chip.difference()), HasSubstr("not compared"));
}

TEST(OwnRtlOfAnSpc3, ItsPortsHaveTheNamesOfTheTable) {
  const cosim::PinMap map = cosim::default_pin_map(kind().pins());
  EXPECT_EQ(map.pins.at("XWR_E_CLOCK").name, "xwr_e_clock_i");
  EXPECT_EQ(map.pins.at("X_INT").name, "x_int_o");
  EXPECT_EQ(map.pins.at("DB_OE").name, "db_oe_o");
}

TEST(OwnRtlOfAnSpc3, KnowsTheParameters) {
  tb::Spc3Settings other;
  other.ready = 9;
  for (const cosim::RtlParameter& each : kind().rtl()->parameters(other))
    EXPECT_EQ(each.usual, std::string(each.key) != "ready") << each.key;
}

}  // namespace
}  // namespace dsdpv1

// The checks of SPI (SP2): kept at the limit, violated one tick beyond, without other findings.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "kinds/dsdpv1/checks/checks.hpp"

namespace dsdpv1 {
namespace {

using bus::Tick;
using checks::Check;

constexpr Level kParallel = 0, kSpi = 1, kUart = 2;

/// A master with times set by the test; ticks of 1/12 ns, by default SP2 with margin.
struct Frame {
  Tick lead = 1000, high = 1000, low = 1000, lag = 1000, gap = 1000;
  Tick setup = 500, hold = 500;  ///< of MOSI, which is the other level outside
};

class Master {
 public:
  explicit Master(Level mode = kSpi) : checks(checks::Limits(checks::rules(Part::kRsu)), Part::kRsu, {mode, 1}) {
    checks.on_violation([this](const checks::Violation& violation) { violations.push_back(violation); });
    set(1000, Pin::kReset, 1);
  }
  /// Two bits, twice.
  void send(const Frame& frame) {
    for (int i = 0; i < 2; ++i) {
      set(now_ + frame.gap, Pin::kXss, 0);
      bit(now_ + frame.lead, frame);
      bit(now_ + frame.low, frame);
      set(now_ + frame.lag, Pin::kXss, 1);
    }
    checks.finish(now_ + 1);
  }
  void set(Tick at, Pin pin, Level level) { checks.pin(now_ = at, pin, level); }

  checks::Checks checks;
  std::vector<checks::Violation> violations;

 private:
  /// MOSI moves before SCK's rise and after it; SCK falls last, or before MOSI's second change when `high` is shorter.
  void bit(Tick rise, const Frame& frame) {
    set(rise - frame.setup, Pin::kMosi, 1);
    set(rise, Pin::kSck, 1);
    if (frame.hold <= frame.high) set(rise + frame.hold, Pin::kMosi, 0);
    set(rise + frame.high, Pin::kSck, 0);
  }
  Tick now_ = 0;
};

struct Case {
  const char* name;
  Check check;
  Tick Frame::*time;
  Tick limit;
  std::uint64_t count;  ///< in two frames of two bits
};

const Case kCases[] = {
    {"SckHigh", Check::kSckHigh, &Frame::high, 600, 4},   {"SckLow", Check::kSckLow, &Frame::low, 600, 2},
    {"XssLead", Check::kXssLead, &Frame::lead, 600, 2},   {"XssLag", Check::kXssLag, &Frame::lag, 600, 2},
    {"XssGap", Check::kXssGap, &Frame::gap, 600, 1},      {"MosiSetup", Check::kMosiSetup, &Frame::setup, 150, 4},
    {"MosiHold", Check::kMosiHold, &Frame::hold, 150, 4},
};

void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }

class SpiValue : public testing::TestWithParam<Case> {
 protected:
  static Frame frame(Tick margin) {
    Frame frame;
    frame.*GetParam().time = GetParam().limit + margin;
    return frame;
  }
};

TEST_P(SpiValue, IsKeptAtTheLimitWithMarginZero) {
  Master master;
  master.send(frame(0));
  const checks::Record& record = master.checks.record(GetParam().check);
  EXPECT_EQ(record.count, GetParam().count);
  EXPECT_EQ(record.worst_margin, 0);
  EXPECT_TRUE(master.violations.empty()) << master.violations.front().text;
}

TEST_P(SpiValue, IsViolatedOneTickBeyond) {
  Master master;
  master.send(frame(-1));
  EXPECT_EQ(master.checks.record(GetParam().check).worst_margin, -1);
  ASSERT_EQ(master.violations.size(), GetParam().count);
  for (const checks::Violation& each : master.violations) {
    EXPECT_EQ(each.check, GetParam().check);
    EXPECT_FALSE(each.history.empty());
  }
}

TEST_P(SpiValue, IsNotJudgedInOtherModesAndInReset) {
  for (const Level mode : {kParallel, kUart}) {
    Master master(mode);
    master.send(frame(-1));
    EXPECT_FALSE(master.checks.applies(GetParam().check));
    EXPECT_EQ(master.checks.record(GetParam().check).count, 0U);
  }
  Master held;
  held.set(2000, Pin::kReset, 0);
  held.send(frame(-1));
  EXPECT_TRUE(held.checks.applies(GetParam().check));
  EXPECT_EQ(held.checks.record(GetParam().check).count, 0U);
}

INSTANTIATE_TEST_SUITE_P(Checks, SpiValue, testing::ValuesIn(kCases), [](const auto& each) { return each.param.name; });

TEST(SpiChecks, EdgesAtOneTickCountTheSameWhicheverIsToldFirst) {
  for (const bool xss_first : {false, true}) {
    Master master;
    master.set(3000, Pin::kXss, 0);
    master.set(4000, Pin::kSck, 1);
    master.set(5000, xss_first ? Pin::kXss : Pin::kSck, xss_first ? 1 : 0);
    master.set(5000, xss_first ? Pin::kSck : Pin::kXss, xss_first ? 0 : 1);
    master.checks.finish(6000);
    EXPECT_EQ(master.checks.record(Check::kXssLag).worst_value, 0);
    EXPECT_EQ(master.checks.record(Check::kSckHigh).worst_value, 1000);
  }
  for (const bool mosi_first : {false, true}) {
    Master master;
    master.set(3000, Pin::kXss, 0);
    master.set(4000, mosi_first ? Pin::kMosi : Pin::kSck, 1);
    master.set(4000, mosi_first ? Pin::kSck : Pin::kMosi, 1);
    EXPECT_EQ(master.checks.record(Check::kMosiHold).worst_value, 0);
    EXPECT_EQ(master.checks.record(Check::kMosiSetup).violations, 0U);
  }
}

TEST(SpiChecks, PeriodOfSckIsNineMegahertz) {
  for (const Tick margin : {Tick{0}, Tick{-1}}) {
    Master master;
    Frame frame;
    frame.high = 666;
    frame.low = 1333 - 666 + margin;
    master.send(frame);
    EXPECT_EQ(master.checks.record(Check::kSckPeriod).count, 2U) << "one in a frame of two bits";
    EXPECT_EQ(master.checks.record(Check::kSckPeriod).worst_margin, margin);
    ASSERT_EQ(master.violations.size(), margin < 0 ? 2U : 0U);
  }
}

TEST(SpiChecks, MisoFollowsSckWithinTenNanoseconds) {
  for (const Tick late : {Tick{0}, Tick{1}}) {
    Master master;
    master.set(3000, Pin::kXss, 0);
    master.set(3000, Pin::kMiso, 1);  // driven, no bit
    master.set(4000, Pin::kSck, 1);
    master.set(5000, Pin::kSck, 0);
    master.set(5120 + late, Pin::kMiso, 0);
    master.set(7000, Pin::kXss, 1);
    master.set(7000, Pin::kMiso, kLevelZ);
    EXPECT_EQ(master.checks.record(Check::kMisoDelay).count, 1U);
    EXPECT_EQ(master.checks.record(Check::kMisoDelay).violations, late == 0 ? 0U : 1U);
  }
}

TEST(SpiChecks, ModeOfThePinDecidesWhatApplies) {
  Master master(kParallel);
  EXPECT_TRUE(master.checks.applies(Check::kTs));
  master.set(2000, Pin::kMode, kSpi);
  EXPECT_FALSE(master.checks.applies(Check::kTs));
  EXPECT_TRUE(master.checks.applies(Check::kSckHigh));
  EXPECT_EQ(checks::rules().size() + 21, checks::rules(Part::kRsu).size()) << "the DSDPV1 has no SPI";
}

}  // namespace
}  // namespace dsdpv1

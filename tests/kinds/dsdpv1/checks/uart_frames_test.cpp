// The checks of the UART port: kept at the limit, violated one tick beyond, at the tick of the violation.
#include <gtest/gtest.h>

#include <optional>

#include "kinds/dsdpv1/checks/checks.hpp"
#include "tests/conformance/host_telegrams.hpp"
#include "tests/kinds/dsdpv1/checks/uart_line.hpp"

namespace dsdpv1 {
namespace {

using checks::Check;
using checks_test::LineCharacter;
using checks_test::Tick;
using conformance::Bytes;
using conformance::with_crc;

constexpr Level kParallel = 0, kSpi = 1, kUart = 2;
constexpr Tick kCycle = 250, kBit = 26 * kCycle, kCharacter = 11 * kBit;
constexpr Tick kFirst = 100'000;             // a multiple of a cycle: the chip sees a fall there an edge later
constexpr Tick kInterval = 7 * 11 * 26 / 2;  // UA3: 3.5 characters, in cycles

const Bytes kRead = with_crc({0x01, 0x00, 0x00, 0x01}), kOtherCard = with_crc({0x02, 0x00, 0x00, 0x01}),
            kReply = with_crc({0x81, 0x00, 0x55});

/// When silence ends a telegram whose last character begins at `fell`: a start bit there is too late, or received
/// again.
constexpr Tick silence_after(Tick fell) { return (fell / kCycle + 1 + 11 * 26 + kInterval + 1) * kCycle; }
/// The tick at which the chip samples bit `index` (0 start, 10 stop) of a character that begins at `fell`.
constexpr Tick sampled(Tick fell, int index) { return (fell / kCycle + 1 + 13 + index * 26) * kCycle; }

class Host {
 public:
  explicit Host(Level mode = kUart, const checks::Limits& limits = checks::Limits(checks::rules(Part::kRsu)))
      : checks(limits, Part::kRsu, settings(mode)) {
    checks.on_violation([this](const checks::Violation& violation) { violations.push_back(violation); });
    set(1000, Pin::kReset, 1);
  }
  void set(Tick at, Pin pin, Level level) { checks.pin(at, pin, level); }
  Tick character(Tick at, const LineCharacter& character) {
    return checks_test::put_character([this](Tick when, bool level) { set(when, Pin::kRxd, level ? 1 : 0); }, at, kBit,
                                      character);
  }
  Tick send(Tick at, const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) at = character(at, {byte});
    return at;
  }
  /// The chip's; the end of its last stop bit.
  Tick reply(Tick at, const Bytes& bytes = kReply) {
    for (const std::uint8_t byte : bytes)
      at = checks_test::put_character([this](Tick when, bool level) { set(when, Pin::kTxd, level ? 1 : 0); }, at, kBit,
                                      {byte});
    return at;
  }
  const checks::Record& record(Check check) const { return checks.record(check); }
  /// The only violation.
  void expect_violation(Check check, Tick at, Tick margin) {
    ASSERT_EQ(violations.size(), 1U);
    EXPECT_EQ(violations[0].check, check) << violations[0].text;
    EXPECT_EQ(violations[0].at, at);
    EXPECT_EQ(violations[0].margin, margin);
    EXPECT_NE(violations[0].text.find("bit times"), std::string::npos) << violations[0].text;
    EXPECT_FALSE(violations[0].history.empty());
  }

  checks::Checks checks;
  std::vector<checks::Violation> violations;

 private:
  static checks::SerialSettings settings(Level mode) {
    checks::SerialSettings settings;
    settings.mode = mode;
    settings.address = 1;
    settings.rate = 7;
    return settings;
  }
};

TEST(RxdCharacterGap, IsKeptUpToTheIntervalAndViolatedOneTickLater) {
  for (const Tick margin : {Tick{0}, Tick{-1}}) {
    Host host;
    host.character(kFirst, {kRead[0]});
    const Tick late = silence_after(kFirst), next = late - 1 - margin;
    host.character(next, {kRead[1]});
    host.checks.finish(next + kCharacter);
    EXPECT_EQ(host.record(Check::kRxdCharacterGap).count, 1U);
    EXPECT_EQ(host.record(Check::kRxdCharacterGap).worst_margin, margin);
    if (margin < 0) host.expect_violation(Check::kRxdCharacterGap, late, margin);
  }
}

TEST(RxdCharacterGap, CountsFromTheEndOfTheCharacterBefore) {
  Host host;
  host.send(kFirst, kRead);
  host.checks.finish(kFirst + 6 * kCharacter);
  EXPECT_EQ(host.record(Check::kRxdCharacterGap).count, 5U);
  EXPECT_EQ(host.record(Check::kRxdCharacterGap).worst_margin, (kInterval + 2) * kCycle - 1) << "no gap at all";
}

TEST(RxdCharacterGap, OfTheNextTelegramIsThatOfB019) {
  Host host;
  host.reply(host.send(kFirst, with_crc({0x21, 0x00, 0x19, 0x01, 0x01})) + 11 * kBit + kCycle, with_crc({0xA1, 0x00}));
  const Tick first = 2'000'000;
  host.character(first, {kRead[0]});
  const Tick late = silence_after(first) - (kInterval - 2 * 11 * 26 / 2) * kCycle;  // UA3: code 1 is one character
  host.checks.finish(host.character(late, {kRead[1]}));
  host.expect_violation(Check::kRxdCharacterGap, late, -1);
}

TEST(RxdCharacterGap, IsThatOfB019UpToItsLastCode) {
  Host host;
  host.reply(host.send(kFirst, with_crc({0x21, 0x00, 0x19, 0x01, 0x07})) + 11 * kBit + kCycle, with_crc({0xA1, 0x00}));
  const Tick first = 2'000'000;
  host.character(first, {kRead[0]});
  const Tick late = silence_after(first) + (200 * 11 * 26 / 2 - kInterval) * kCycle;  // UA3: code 7 is 100 characters
  host.checks.finish(host.character(late, {kRead[1]}));
  host.expect_violation(Check::kRxdCharacterGap, late, -1);
}

TEST(RxdCharacterGap, OfATelegramWithoutAnEndIsFoundAtTheEndOfTheRun) {
  Host host;
  host.character(kFirst, {kRead[0]});
  const Tick late = silence_after(kFirst);
  host.checks.finish(late + 77);
  host.expect_violation(Check::kRxdCharacterGap, late, -78);
}

TEST(RxdSilence, IsAskedForAfterATelegramThatWasSpoilt) {
  for (const Tick margin : {Tick{0}, Tick{-1}}) {
    Host host;
    Tick at = host.character(kFirst, {kRead[0], true});
    for (std::size_t i = 1; i < kRead.size(); ++i) at = host.character(at, {kRead[i]});
    const Tick again = silence_after(at - kCharacter) + margin;
    host.send(again, kRead);
    EXPECT_EQ(host.record(Check::kRxdParity).violations, 1U);
    EXPECT_EQ(host.record(Check::kRxdSilence).count, 1U) << "the rest of the telegram is none";
    EXPECT_EQ(host.record(Check::kRxdSilence).worst_margin, margin);
    ASSERT_EQ(host.violations.size(), margin < 0 ? 2U : 1U);
    if (margin < 0) EXPECT_EQ(host.violations[1].at, again);
    host.reply(again + 6 * kCharacter + 11 * kBit + kCycle);
    EXPECT_EQ(host.record(Check::kTxdReplyTime).count, margin < 0 ? 0U : 1U) << "is it heard?";
  }
}

TEST(RxdHalfDuplex, IsKeptFromTheReplysEndOnAndViolatedOneTickSooner) {
  for (const Tick margin : {Tick{0}, Tick{-1}}) {
    Host host;
    const Tick begun = host.send(kFirst, kRead) + 11 * kBit + kCycle, end = begun + 5 * kCharacter;
    host.reply(begun, Bytes(kReply.begin(), kReply.end() - 1));
    // the last character of the reply with the next request's first edge in it
    const Tick last = end - kCharacter, free = end - 2 * kCycle;
    host.set(last, Pin::kTxd, 0);
    host.set(last + kBit, Pin::kTxd, 1);
    host.send(free + margin, kRead);
    EXPECT_EQ(host.record(Check::kRxdHalfDuplex).count, 1U);
    EXPECT_EQ(host.record(Check::kRxdHalfDuplex).worst_margin, margin);
    if (margin < 0) {
      ASSERT_FALSE(host.violations.empty());
      EXPECT_EQ(host.violations[0].at, free - 1);
    }
    host.reply(free + 6 * kCharacter + 12 * kBit);
    EXPECT_EQ(host.record(Check::kTxdReplyTime).count, margin < 0 ? 1U : 2U) << "is the second telegram heard?";
  }
}

TEST(RxdHalfDuplex, IsViolatedOnceATelegramFromItsLastStopBitOn) {
  Host host;
  host.send(kFirst, kRead);
  const Tick last = kFirst + 5 * kCharacter, talks = sampled(last, 10);
  host.set(talks, Pin::kRxd, 0);
  host.set(talks + kBit, Pin::kRxd, 1);
  host.set(talks + 2 * kBit, Pin::kRxd, 0);
  host.set(talks + 3 * kBit, Pin::kRxd, 1);
  const Tick end = host.reply(last + kCharacter + 11 * kBit + kCycle);
  host.checks.finish(end + 1);
  host.expect_violation(Check::kRxdHalfDuplex, talks, talks - (end - 2 * kCycle));
}

TEST(RxdHalfDuplex, DoesNotConcernTelegramsForTheOtherCard) {
  Host host;
  host.send(host.send(kFirst, kOtherCard), kRead);
  host.checks.finish(kFirst + 12 * kCharacter);
  EXPECT_EQ(host.record(Check::kRxdHalfDuplex).count, 0U);
  EXPECT_TRUE(host.violations.empty());
}

TEST(RxdFraming, AsksForAStopBitJustBeforeItsSampling) {
  const Tick stop = sampled(kFirst, 10);
  for (const Tick late : {Tick{0}, Tick{1}}) {  // 3F: low from data bit 6 on, parity included
    Host host;
    host.set(kFirst, Pin::kRxd, 0);
    host.set(kFirst + kBit, Pin::kRxd, 1);
    host.set(kFirst + 7 * kBit, Pin::kRxd, 0);
    host.set(stop - 1 + late, Pin::kRxd, 1);
    host.checks.finish(stop + 10 * kBit);
    EXPECT_EQ(host.record(Check::kRxdFraming).worst_margin, -late);
    EXPECT_EQ(host.record(Check::kRxdBreak).count, 0U);
    if (late != 0) EXPECT_EQ(host.violations[0].at, stop);
  }
}

TEST(RxdFraming, HasTheMarginToTheNextStartBitToo) {
  Host host;
  host.set(kFirst, Pin::kRxd, 0);
  host.set(kFirst + kBit, Pin::kRxd, 1);
  host.set(sampled(kFirst, 10) + 3, Pin::kRxd, 0);
  host.checks.finish(sampled(kFirst, 10) + kCycle);
  EXPECT_EQ(host.record(Check::kRxdFraming).worst_margin, 3);
}

TEST(RxdBreak, IsACharacterThatIsLowForAllItsTime) {
  const Tick stop = sampled(kFirst, 10);
  for (const Tick late : {Tick{0}, Tick{1}}) {
    Host host;
    host.set(kFirst, Pin::kRxd, 0);
    host.set(stop - 1 + late, Pin::kRxd, 1);
    host.checks.finish(stop + kBit);
    EXPECT_EQ(host.record(Check::kRxdBreak).count, 1U);
    EXPECT_EQ(host.record(Check::kRxdFraming).count, 0U);
    if (late != 0)
      host.expect_violation(Check::kRxdBreak, stop, -1);
    else
      EXPECT_TRUE(host.violations.empty());
  }
}

TEST(RxdBreak, IsNoCharacterWhoseParityBitAloneIsHigh) {
  Host host;
  LineCharacter character;
  character.wrong_parity = character.no_stop_bit = true;
  host.checks.finish(host.character(kFirst, character) + 20 * kBit);
  EXPECT_EQ(host.record(Check::kRxdBreak).count, 0U);
  EXPECT_EQ(host.record(Check::kRxdFraming).violations, 1U);
}

TEST(RxdParity, IsJudgedAtTheStopBit) {
  Host host;
  host.character(kFirst, {0x01, true});
  host.checks.finish(kFirst + kCharacter);
  ASSERT_EQ(host.violations.size(), 1U);
  EXPECT_EQ(host.violations[0].check, checks::CheckId(Check::kRxdParity));
  EXPECT_EQ(host.violations[0].at, sampled(kFirst, 10));
}

TEST(RxdSampler, PulsesThatNoEdgeSeesOrThatAreOverInMidBitAreNoCharacter) {
  Host host;
  host.set(kFirst + 1, Pin::kRxd, 0);
  host.set(kFirst + kCycle - 1, Pin::kRxd, 1);
  host.set(kFirst + 2 * kCycle, Pin::kRxd, 0);
  host.set(sampled(kFirst + 2 * kCycle, 0) - 1, Pin::kRxd, 1);
  host.checks.finish(kFirst + 3 * kCharacter);
  EXPECT_EQ(host.record(Check::kRxdParity).count, 0U);
  EXPECT_TRUE(host.violations.empty());
}

TEST(TxdReply, IsNotBeforeItsBitTimesAndItsDelayIsMeasured) {
  for (const Tick margin : {Tick{0}, Tick{-1}}) {
    Host host;
    const Tick end = host.send(kFirst, kRead), begins = end + 11 * kBit + margin;
    host.reply(begins);
    EXPECT_EQ(host.record(Check::kTxdReplyEarly).worst_margin, margin);
    EXPECT_EQ(host.record(Check::kTxdReplyTime).worst_value, begins - end);
    if (margin < 0) host.expect_violation(Check::kTxdReplyEarly, begins, -1);
  }
}

TEST(TxdReply, IsAskedForAfterTheBitTimesOfB01A) {
  Host host;
  const Tick first = host.send(kFirst, with_crc({0x21, 0x00, 0x1A, 0x01, 0x14}));
  Tick end = host.reply(first + 11 * kBit + kCycle, with_crc({0xA1, 0x00}));
  EXPECT_TRUE(host.violations.empty()) << "the write itself is replied to with the old time";
  end = host.send(end + kBit, kRead);
  host.reply(end + 20 * kBit - 1);
  host.expect_violation(Check::kTxdReplyEarly, end + 20 * kBit - 1, -1);
}

TEST(TxdReply, HasALatestTimeWhenTheScenarioSaysSo) {
  checks::Limits limits(checks::rules(Part::kRsu));
  limits[Check::kTxdReplyTime].value = 12 * kBit;
  Host host(kUart, limits);
  const Tick end = host.send(kFirst, kRead);
  host.reply(end + 12 * kBit + 1);
  host.expect_violation(Check::kTxdReplyTime, end + 12 * kBit + 1, -1);

  Host silent(kUart, limits);
  silent.send(kFirst, kRead);
  silent.checks.finish(end + 12 * kBit + 5);
  silent.expect_violation(Check::kTxdReplyTime, end + 12 * kBit + 5, -5);
}

TEST(BlockServed, ExchangeThatCarriesTheNewsIsALook) {
  Host host;
  host.set(kFirst, Pin::kIntr0, 0);
  const Tick asked = host.send(kFirst, with_crc({0x41, 0x00, 0x01, 0x30, 0x01, 0x00}));  // empty inputs
  const Tick end = host.reply(asked + 11 * kBit + kCycle, with_crc({0xC1, 0x10, 0x04, 0x10, 0x01, 0x00}));  // Set_Prm
  host.checks.finish(end + 200 * bus::kTicksPerMs);
  EXPECT_EQ(host.record(Check::kBlockServed).worst_value, end - kFirst);
  EXPECT_EQ(host.record(Check::kBlockServed).violations, 0U);
}

TEST(UartChecks, AreOfThatModeAndNotInReset) {
  for (const Level mode : {kParallel, kSpi}) {
    Host host(mode);
    host.character(kFirst, {0x01, true, true});
    host.checks.finish(kFirst + kCharacter);
    EXPECT_FALSE(host.checks.applies(Check::kRxdParity));
    EXPECT_EQ(host.record(Check::kRxdFraming).count, 0U);
  }
  Host held;
  held.set(2000, Pin::kReset, 0);
  held.set(kFirst, Pin::kRxd, 0);
  held.set(kFirst + 2 * kCharacter, Pin::kReset, 1);
  held.set(kFirst + 4 * kCharacter, Pin::kRxd, 1);
  held.checks.finish(kFirst + 5 * kCharacter);
  EXPECT_TRUE(held.checks.applies(Check::kRxdBreak));
  EXPECT_FALSE(held.checks.applies(Check::kSckHigh));
  EXPECT_EQ(held.record(Check::kRxdBreak).count, 0U) << "low since before the chip looked";
}

TEST(UartChecks, TakeRateAndIntervalFromTheStraps) {
  Host host;
  host.set(1000, Pin::kUbr, 6);  // 104 cycles a bit
  host.set(1000, Pin::kUiv, 1);  // one character
  host.set(1000, Pin::kReset, 0);
  host.set(2000, Pin::kReset, 1);
  constexpr Tick kSlow = 104 * kCycle;
  checks_test::put_character([&host](Tick at, bool level) { host.set(at, Pin::kRxd, level ? 1 : 0); }, kFirst, kSlow,
                             {0x01});
  host.checks.finish((kFirst / kCycle + 1 + 2 * 11 * 104 + 1) * kCycle);
  EXPECT_EQ(host.record(Check::kRxdParity).count, 1U);
  EXPECT_EQ(host.record(Check::kRxdCharacterGap).worst_margin, -1);
}

}  // namespace
}  // namespace dsdpv1

// The checks of SPI's telegrams: 2.7 us after a write (SP9), the hold by B014 (SP12), to the tick.
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "bus/monitor/monitor.hpp"
#include "kinds/dsdpv1/checks/checks.hpp"
#include "tests/conformance/host_telegrams.hpp"

namespace dsdpv1 {
namespace {

using bus::Bytes;
using bus::Tick;
using checks::Check;
using conformance::with_crc;

constexpr Level kSpi = 1;
constexpr Tick kHalf = 667;  ///< of SCK's period

const Bytes kClaim = with_crc({0x21, 0x00, 0x14, 0x01, 0x02}), kRelease = with_crc({0x21, 0x00, 0x14, 0x01, 0x00}),
            kLook = with_crc({0x01, 0x00, 0x14, 0x01}), kWrite = with_crc({0x21, 0x00, 0x20, 0x01, 0x55}),
            kDone = with_crc({0xA1, 0x00}), kRefused = with_crc({0xE1, 0x00});

/// A host and the chip's replies.
class Host {
 public:
  explicit Host(std::optional<Tick> longest = {}, std::uint32_t reply_gap = 0)
      : checks(limits(longest), Part::kRsu, settings(reply_gap)) {
    checks.on_violation([this](const checks::Violation& violation) { violations.push_back(violation); });
    set(1000, Pin::kReset, 1);
  }
  /// A frame whose XSS falls at `at`; returns the tick of the request's last bit.
  Tick frame(Tick at, const Bytes& request, const Bytes& reply) {
    Bytes out = request, in(request.size(), 0xFF);
    out.insert(out.end(), reply.size(), 0xFF);
    in.insert(in.end(), reply.begin(), reply.end());
    set(at, Pin::kXss, 0);
    for (std::size_t bit = 0; bit < 8 * out.size(); ++bit) {
      at += kHalf;
      set(at - kHalf + 100, Pin::kMiso, bit_of(in, bit));
      set(at - 300, Pin::kMosi, bit_of(out, bit));
      set(at, Pin::kSck, 1);
      if (bit + 1 == 8 * request.size()) last_bit_ = at;
      set(at += kHalf, Pin::kSck, 0);
    }
    set(end_ = at + kHalf, Pin::kXss, 1);
    return last_bit_;
  }
  /// The answer of station 5 on the line, framed by PBRTS: from it the address is learnt.
  void answer(Tick at) {
    bus::WireTelegram answer = on_line(bus::make_sc(), at + 1000, at + 12'000);
    answer.tsdr = 11'000;
    answer.station = kStation;
    set(at, Pin::kPbrts, 1);
    set(at + 13'000, Pin::kPbrts, 0);
    checks.telegram(at + 13'000, answer);
  }
  /// A Data_Exchange to it that ends at `end`.
  void exchange(Tick end) {
    constexpr std::uint8_t kMaster = 2, kFc = bus::fc::kRequest | bus::fc::kSrdHigh;
    checks.telegram(end, on_line(bus::make_telegram(kStation, kMaster, kFc, {0x11}), end - 10'000, end));
  }
  Tick end() const { return end_; }
  const checks::Record& record(Check check) const { return checks.record(check); }

  checks::Checks checks;
  std::vector<checks::Violation> violations;

 private:
  static constexpr std::uint8_t kStation = 5;
  static bus::WireTelegram on_line(const bus::Telegram& telegram, Tick start, Tick end) {
    bus::WireTelegram wire;
    wire.decoded.readable = true;
    wire.decoded.telegram = telegram;
    wire.start = start;
    wire.end = end;
    return wire;
  }
  static checks::Limits limits(std::optional<Tick> longest) {
    checks::Limits limits(checks::rules(Part::kRsu));
    if (longest) limits[Check::kOwned].value = *longest;
    return limits;
  }
  static checks::SerialSettings settings(std::uint32_t reply_gap) {
    checks::SerialSettings settings;
    settings.mode = kSpi;
    settings.address = 1;
    settings.spi_reply_gap = reply_gap;
    return settings;
  }
  static Level bit_of(const Bytes& bytes, std::size_t bit) {
    return (bytes[bit / 8] >> (7 - bit % 8) & 1) != 0 ? Level{1} : Level{0};
  }
  void set(Tick at, Pin pin, Level level) { checks.pin(at, pin, level); }
  Tick last_bit_ = 0, end_ = 0;
};

TEST(SpiWriteGap, IsKeptAtTwoPointSevenMicrosecondsAndViolatedOneTickSooner) {
  for (const Tick margin : {Tick{0}, Tick{-1}}) {
    Host host;
    const Tick begun = host.frame(10'000, kWrite, {}) + 32'400 + margin;
    host.frame(begun, kLook, {});
    const checks::Record& record = host.record(Check::kWriteGap);
    EXPECT_EQ(record.count, 1U);
    EXPECT_EQ(record.worst_margin, margin);
    EXPECT_EQ(record.at, begun);
    ASSERT_EQ(host.violations.size(), margin < 0 ? 1U : 0U);
    if (margin < 0) EXPECT_EQ(host.violations[0].at, begun);
  }
}

TEST(SpiWriteGap, IsAskedForAfterWritesToThisCardOnlyRightOrWrong) {
  const struct {
    Bytes request;
    std::uint64_t count;
  } cases[] = {{kLook, 0},
               {with_crc({0x22, 0x00, 0x20, 0x01, 0x55}), 0},
               {with_crc({0x21, 0x00, 0x20, 0x01, 0x55}, 1), 1},
               {with_crc({0x41, 0x01, 0x55}), 1},
               {{0x21, 0x00, 0x20, 0x01, 0x55, 0x00}, 0}};
  for (const auto& each : cases) {
    Host host;
    host.frame(10'000, each.request, {});
    host.frame(host.end() + 50'000, kLook, {});
    EXPECT_EQ(host.record(Check::kWriteGap).count, each.count);
  }
}

TEST(SpiWriteGap, OfAWriteInAFrameThatIsNotHeardIsNotAskedFor) {
  Host host;
  host.frame(host.frame(10'000, kWrite, {}) + 700, kWrite, {});
  host.frame(host.end() + 600, kLook, {});
  EXPECT_EQ(host.record(Check::kWriteGap).count, 2U) << "both after the first";
  EXPECT_EQ(host.record(Check::kWriteGap).violations, 1U);
}

TEST(SpiReply, BeginsRightAfterTheRequestOrSoManyBytesLater) {
  const struct {
    std::uint32_t gap;
    Bytes reply;
    std::uint64_t count, violations;
  } cases[] = {{0, kDone, 1, 0},        {0, {}, 0, 0},
               {0, {0xFF, 0xA1}, 1, 1}, {2, {0xFF, 0xFF, 0xA1}, 1, 0},
               {2, {0xFF, 0xFF}, 0, 0}, {2, {0xFF, 0xFF, 0xFF}, 1, 1},
               {2, {0xFF, 0xA1}, 1, 1}};
  for (const auto& each : cases) {
    Host host({}, each.gap);
    host.frame(10'000, kWrite, each.reply);
    EXPECT_EQ(host.record(Check::kMisoReply).count, each.count);
    EXPECT_EQ(host.record(Check::kMisoReply).violations, each.violations);
  }
}

TEST(SpiOwned, IsMeasuredFromTheClaimsLastBitToTheReleases) {
  for (const Tick margin : {Tick{0}, Tick{-1}}) {
    constexpr Tick kFirst = 10'000, kSecond = 2'000'000;
    Host host(kSecond - kFirst + margin);
    host.frame(kFirst, kClaim, kDone);
    const Tick released = host.frame(kSecond, kRelease, kDone);
    const checks::Record& record = host.record(Check::kOwned);
    EXPECT_EQ(record.count, 1U);
    EXPECT_EQ(record.worst_value, kSecond - kFirst);
    EXPECT_EQ(record.worst_margin, margin);
    ASSERT_EQ(host.violations.size(), margin < 0 ? 1U : 0U);
    if (margin < 0) EXPECT_EQ(host.violations[0].at, released);
  }
}

TEST(SpiOwned, HasNotBegunWithARefusedOrWrongClaimAndEndsWhenB014SaysSo) {
  Host refused;
  refused.frame(10'000, kClaim, kRefused);
  refused.frame(200'000, with_crc({0x21, 0x00, 0x14, 0x01, 0x02}, 1), with_crc({0xE1, 0x01}));
  refused.checks.finish(1'000'000);
  EXPECT_EQ(refused.record(Check::kOwned).count, 0U);

  Host ended;
  ended.frame(10'000, kClaim, kDone);
  ended.frame(200'000, kLook, with_crc({0x81, 0x00, 0x02}));
  EXPECT_EQ(ended.record(Check::kOwned).count, 0U);
  ended.frame(500'000, kLook, with_crc({0x81, 0x00, 0x00}));
  EXPECT_EQ(ended.record(Check::kOwned).count, 1U);
}

TEST(SpiOwned, CountsFromTheFirstOfTwoClaims) {
  Host host;
  host.frame(10'000, kClaim, kDone);
  host.frame(300'000, kClaim, kDone);
  host.frame(2'000'000, kRelease, kDone);
  EXPECT_EQ(host.record(Check::kOwned).worst_value, 2'000'000 - 10'000);
}

/// From its last bit to XSS's rise (SP16), of the time between two Data_Exchange.
TEST(SpiHoldInterval, ReadAndWriteHoldsAsLongAsItsFrame) {
  constexpr Tick kFirst = 300'000, kSecond = 900'000;
  Host host;
  host.answer(50'000);
  host.exchange(kFirst);
  const Tick asked = host.frame(kFirst + 50'000, with_crc({0x41, 0x01, 0x55}), with_crc({0xC1, 0x00, 0x00}));
  const Tick held = host.end() - asked;
  host.exchange(kSecond);
  host.checks.finish(kSecond + 20'000);
  const checks::Record& record = host.record(Check::kOwnerInterval);
  EXPECT_EQ(record.count, 1U);
  EXPECT_EQ(record.worst_value, kSecond - kFirst - held);
}

TEST(SpiOwned, LastsToTheEndOfTheRunWhenNobodyReleases) {
  Host host;
  const Tick claimed = host.frame(10'000, kClaim, kDone);
  host.checks.finish(130'000'000);
  EXPECT_EQ(host.record(Check::kOwned).worst_value, 130'000'000 - claimed);
  EXPECT_EQ(host.record(Check::kOwned).violations, 1U);
}

}  // namespace
}  // namespace dsdpv1

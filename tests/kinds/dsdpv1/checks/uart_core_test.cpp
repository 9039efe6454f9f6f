// The checks of the UART port compared with the chip: random lines, valid and with every kind of fault known to a
// check. Both are independent, and must have the same findings.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "kinds/dsdpv1/checks/checks.hpp"
#include "model/dsdpv1/chip.hpp"
#include "model/dsdpv1/reasons.hpp"
#include "tests/conformance/host_telegrams.hpp"
#include "tests/kinds/dsdpv1/checks/uart_line.hpp"

namespace dsdpv1 {
namespace {

using checks::Check;
using checks_test::Tick;
using conformance::Bytes;
using conformance::with_crc;

constexpr Tick kBit = 26 * 250;

class Both {
 public:
  Both() : chip_(config()), checks_(checks::Limits(checks::rules(Part::kRsu)), Part::kRsu) {
    chip_.watch({&keep_pin, this}, mask(Pin::kTxd));
    chip_.on_event({&keep_event, this});
    set(0, Pin::kMode, 2);
    set(0, Pin::kAdr, 1);
    set(0, Pin::kUbr, 7);
    set(5000, Pin::kReset, 1);
    pass(1'000'000);
  }
  Tick now() const { return now_; }
  void pass(Tick ticks) { chip_.advance(now_ += ticks); }
  void set(Tick at, Pin pin, Level level) {
    now_ = at;
    chip_.set(at, pin, level);
    checks_.pin(at, pin, level);
  }
  void put(Tick bit, const checks_test::LineCharacter& character) {
    pass(checks_test::put_character([this](Tick at, bool level) { set(at, Pin::kRxd, level ? 1 : 0); }, now_, bit,
                                    character) -
         now_);
  }
  void finish() {
    pass(10'000'000);
    checks_.finish(now_);
  }
  std::uint64_t events(profibus::Reason reason) const {
    return static_cast<std::uint64_t>(std::count_if(
        events_.begin(), events_.end(), [reason](const profibus::Event& each) { return each.reason == reason; }));
  }
  std::uint64_t violations(Check check) const { return checks_.record(check).violations; }
  std::uint64_t count(Check check) const { return checks_.record(check).count; }
  std::uint64_t replies() const { return replies_; }

 private:
  static Config config() {
    Config config;
    config.part = Part::kRsu;
    return config;
  }
  static void keep_pin(void* self, Tick at, Pin pin, Level level) {
    auto& both = *static_cast<Both*>(self);
    both.checks_.pin(at, pin, level);
    if (level == 0 && at >= both.reply_until_) ++both.replies_;
    if (level == 0) both.reply_until_ = std::max(both.reply_until_, at + 12 * kBit);
  }
  static void keep_event(void* self, const profibus::Event& event) {
    static_cast<Both*>(self)->events_.push_back(event);
  }

  Chip chip_;
  checks::Checks checks_;
  std::vector<profibus::Event> events_;
  std::uint64_t replies_ = 0;
  Tick now_ = 0, reply_until_ = 0;
};

class Traffic {
 public:
  explicit Traffic(unsigned seed) : random_(seed) {}
  int below(int limit) { return static_cast<int>(random_() % static_cast<unsigned>(limit)); }
  bool one_in(int n) { return below(n) == 0; }

  Bytes telegram() {
    const auto card = static_cast<std::uint8_t>(one_in(6) ? 2 : 1);
    Bytes telegram = {card, 0x00, static_cast<std::uint8_t>(below(8)), static_cast<std::uint8_t>(below(4))};
    if (one_in(4))
      telegram = {static_cast<std::uint8_t>(0x20 | card), 0x00, 0x19, 1, static_cast<std::uint8_t>(below(4))};
    if (one_in(4))
      telegram = {static_cast<std::uint8_t>(0x20 | card), 0x00, 0x1A, 1, static_cast<std::uint8_t>(below(40))};
    if (one_in(4))
      telegram = {static_cast<std::uint8_t>(0x40 | card), 0x00, 0x01, 0x30, 2, 1,
                  static_cast<std::uint8_t>(below(256))};
    if (one_in(15)) telegram[0] = static_cast<std::uint8_t>(below(256));
    telegram = with_crc(telegram, one_in(8) ? 1 : 0);
    if (one_in(10)) telegram.resize(1 + static_cast<std::size_t>(below(static_cast<int>(telegram.size()))));
    return telegram;
  }
  void send(Both& both) {
    const Tick bit = one_in(4) ? kBit - 350 + below(700) : kBit;
    for (const std::uint8_t byte : telegram()) {
      both.put(bit, {byte, one_in(60), one_in(60)});
      if (one_in(12)) both.pass(below(2 * 1001 * 250));
      if (one_in(40)) disturb(both);
    }
  }
  void wait(Both& both) {
    if (one_in(5)) return both.pass(below(60 * static_cast<int>(kBit)));  // into the reply, perhaps
    both.pass(150 * kBit + below(9 * static_cast<int>(kBit)));
  }

 private:
  void disturb(Both& both) {
    both.set(both.now() + 1 + below(500), Pin::kRxd, 0);
    both.set(both.now() + 1 + below(14 * static_cast<int>(kBit)), Pin::kRxd, 1);
    both.pass(1);
  }
  std::mt19937 random_;
};

class UartChecksAndCore : public testing::TestWithParam<unsigned> {};

TEST_P(UartChecksAndCore, FindTheSameOnRandomLines) {
  Both both;
  Traffic traffic(GetParam());
  for (int i = 0; i < 600; ++i) {
    traffic.send(both);
    traffic.wait(both);
  }
  both.finish();
  EXPECT_EQ(both.violations(Check::kRxdParity), both.events(Reason::kUartParity));
  EXPECT_EQ(both.violations(Check::kRxdFraming) + both.violations(Check::kRxdBreak), both.events(Reason::kUartFraming));
  EXPECT_EQ(both.violations(Check::kRxdCharacterGap), both.events(Reason::kTelegramCut));
  EXPECT_EQ(both.violations(Check::kRxdHalfDuplex), both.events(Reason::kUartHalfDuplex));
  EXPECT_EQ(both.count(Check::kTxdReplyTime), both.replies());
  EXPECT_EQ(both.violations(Check::kTxdReplyEarly), 0U);
  for (const Check check : {Check::kRxdParity, Check::kRxdFraming, Check::kRxdBreak, Check::kRxdCharacterGap,
                            Check::kRxdHalfDuplex, Check::kRxdSilence})
    EXPECT_GT(both.violations(check), 0U) << checks::rule(check).id;
  EXPECT_GT(both.replies(), 50U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, UartChecksAndCore, testing::Range(1U, 7U));

}  // namespace
}  // namespace dsdpv1

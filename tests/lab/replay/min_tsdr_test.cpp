// The possible min_TSDR of a recorded slave.
#include "lab/replay/min_tsdr.hpp"

#include <gtest/gtest.h>

#include "lab/replay/services.hpp"
#include "tests/lab/replay/captures.hpp"

namespace dsdpv1 {
namespace {

using bus::Bytes;
using bus::Telegram;
using replay_test::inputs;
using replay_test::kBaud;
using replay_test::kMaster;
using replay_test::kSlave;
using replay_test::outputs;
using replay_test::to_slave;

constexpr std::uint8_t kLock = 0x80, kUnlock = 0x40;

class ReplayMinTsdr : public testing::Test {
 protected:
  static Telegram set_prm(std::uint8_t status, std::uint8_t bits) {
    return to_slave(bus::sap::kSetPrm, {status, 0, 0, bits, 0x12, 0x34, 0});
  }
  static tb::replay::RecordedTelegram recorded(const Bytes& bytes) {
    tb::replay::RecordedTelegram telegram;
    telegram.bytes = bytes;
    telegram.decoded = bus::decode(bytes);
    return telegram;
  }
  void acknowledged(const Telegram& request) { min_tsdr_.take(request, &short_); }
  void refused(const Telegram& request) { min_tsdr_.take(request, &refusal_); }
  void exchange() { min_tsdr_.take(outputs({1}), &inputs_); }
  /// Slave_Diag with this second byte.
  void diagnosed(std::uint8_t status) {
    const tb::replay::RecordedTelegram answer =
        recorded(bus::encode(replay_test::from_slave(bus::sap::kSlaveDiag, {0, status, 0, kMaster, 0x12, 0x34})));
    min_tsdr_.take(to_slave(bus::sap::kSlaveDiag), &answer);
  }
  int least() const { return min_tsdr_.least(); }

  tb::replay::MinTsdr min_tsdr_{kBaud};

 private:
  const tb::replay::RecordedTelegram short_ = recorded({0xE5});
  const tb::replay::RecordedTelegram inputs_ = recorded(bus::encode(inputs({2})));
  const tb::replay::RecordedTelegram refusal_ =
      recorded(bus::encode(bus::make_telegram(kMaster, kSlave, bus::fc::kRs)));
};

TEST_F(ReplayMinTsdr, IsCertainOnceDataAreExchanged) {
  EXPECT_EQ(least(), 11);
  acknowledged(set_prm(kLock, 40));
  EXPECT_EQ(least(), 11) << "it may have been refused";
  exchange();
  EXPECT_EQ(least(), 40);
  acknowledged(set_prm(kLock, 20));
  EXPECT_EQ(least(), 20);
  exchange();
  EXPECT_EQ(least(), 20);
  acknowledged(set_prm(kLock, 0));
  exchange();
  EXPECT_EQ(least(), 20) << "S6: 0 leaves it";
}

TEST_F(ReplayMinTsdr, IsNotThatOfASetPrmWithoutEffect) {
  acknowledged(set_prm(kLock, 40));
  exchange();
  acknowledged(set_prm(kUnlock, 20));
  EXPECT_EQ(least(), 40) << "S17";
  acknowledged(set_prm(kLock | kUnlock, 20));
  EXPECT_EQ(least(), 40) << "S17";
  refused(set_prm(kLock, 20));
  EXPECT_EQ(least(), 40) << "S12";
  acknowledged(to_slave(bus::sap::kSetPrm, {kLock, 0, 0, 20}));
  EXPECT_EQ(least(), 40) << "S14";
}

TEST_F(ReplayMinTsdr, WithNeitherLockNorUnlockHoldsAtOnce) {
  acknowledged(set_prm(0, 40));
  EXPECT_EQ(least(), 40) << "S28";
  acknowledged(set_prm(0, 5));
  EXPECT_EQ(least(), 11) << "S11";
  refused(set_prm(0, 40));
  EXPECT_EQ(least(), 11);
}

TEST_F(ReplayMinTsdr, OfASetPrmWithoutAnAnswerMayBeInForce) {
  acknowledged(set_prm(0, 40));
  min_tsdr_.take(set_prm(0, 20), nullptr);
  EXPECT_EQ(least(), 20);
  min_tsdr_.take(set_prm(kLock, 30), nullptr);
  exchange();
  EXPECT_EQ(least(), 20) << "which of them was heard is not known";
}

TEST_F(ReplayMinTsdr, IsSetBySrdOnly) {
  acknowledged(set_prm(0, 40));
  for (const std::uint8_t function : {bus::fc::kSdaHigh, bus::fc::kSdaLow, bus::fc::kSdnHigh, bus::fc::kSdnLow}) {
    Telegram other = set_prm(0, 20);
    other.fc = static_cast<std::uint8_t>(bus::fc::kRequest | function);
    min_tsdr_.take(other, nullptr);
    EXPECT_EQ(least(), 40) << "S20";
  }
}

TEST_F(ReplayMinTsdr, MayBeThatOfAPowerOnWhereTheSlaveWantsParameters) {
  acknowledged(set_prm(kLock, 40));
  exchange();
  diagnosed(0x00);
  EXPECT_EQ(least(), 40);
  diagnosed(tb::replay::kPrmReq);
  EXPECT_EQ(least(), 11) << "it may have restarted";
  acknowledged(set_prm(kLock, 40));
  exchange();
  EXPECT_EQ(least(), 40);
}

}  // namespace
}  // namespace dsdpv1

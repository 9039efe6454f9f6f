// The host as a station of the segment: serve keeps the times that the host cannot keep.
#include "tb/serve/host_line.hpp"

#include <gtest/gtest.h>

#include "bus/monitor/monitor.hpp"
#include "bus/telegram/telegram.hpp"

namespace dsdpv1 {
namespace {

using bus::Bytes;
using bus::Tick;

constexpr int kBaud = 8;  // 19.2k
constexpr Tick kBit = bus::baud(kBaud).bit;

const Bytes kRequest = bus::encode(bus::make_telegram(8, 2, 0x49));
const Bytes kAnswer = bus::encode(bus::make_telegram(2, 8, 0x00));
const Bytes kUnanswered = bus::encode(bus::make_telegram(127, 2, 0x46, {0x00, 0x00}, 58, 62));

class HostLineTest : public testing::Test {
 protected:
  HostLineTest() {
    other_.set_timing(kBit);
    monitor_.set_baud(kBaud);
    monitor_.on_telegram = [this](const bus::WireTelegram& telegram) { heard_.push_back(telegram); };
    monitor_.on_flag = [this](const bus::Flag& flag) { flags_.push_back(flag.kind); };
    timeline_.check_announcements();
    timeline_.add(monitor_);
    timeline_.add(line_);
  }
  /// Another station sends.
  void send(Tick at, const Bytes& bytes) {
    other_.send(at, bus::characters(bytes));
    while (other_.busy()) {
      timeline_.run_until(other_.next());
      other_.run(timeline_.now());
    }
  }

  bus::Timeline timeline_;
  bus::Segment segment_;
  bus::StationId station_ = segment_.attach("other", nullptr);
  bus::UartSender other_{segment_, station_};
  bus::Monitor monitor_{segment_};
  tb::serve::HostLine line_{segment_, kBaud};
  std::vector<bus::WireTelegram> heard_;
  std::vector<bus::FlagKind> flags_;
};

TEST_F(HostLineTest, ATelegramStartsWhenItComesAndHasNoGaps) {
  line_.send(100 * kBit, kRequest);
  timeline_.run_until(300 * kBit);
  ASSERT_EQ(heard_.size(), 1U);
  EXPECT_TRUE(heard_[0].right());
  EXPECT_EQ(heard_[0].start, 100 * kBit);
  EXPECT_EQ(heard_[0].end, (100 + 6 * 11) * kBit);
  EXPECT_EQ(line_.statistics().held_back, 0U);
}

TEST_F(HostLineTest, ARequestWaitsForTheSlotTimeOfTheOneBefore) {
  line_.send(100 * kBit, kRequest);
  line_.send(100 * kBit, kRequest);
  timeline_.run_until(1000 * kBit);
  ASSERT_EQ(heard_.size(), 2U);
  EXPECT_EQ(heard_[1].start, heard_[0].end + bus::baud(kBaud).slot_bits * kBit);
  EXPECT_EQ(line_.statistics().held_back, 1U);
  EXPECT_EQ(line_.statistics().longest_held_back, heard_[1].start - 100 * kBit);
}

TEST_F(HostLineTest, ARequestWaitsForTheAnswerAndTSyn) {
  line_.send(100 * kBit, kRequest);
  line_.send(100 * kBit, kRequest);
  timeline_.run_until((166 + 5) * kBit);
  send((166 + 11) * kBit, kAnswer);
  timeline_.run_until(1000 * kBit);
  ASSERT_EQ(heard_.size(), 3U);
  EXPECT_EQ(heard_[2].start, heard_[1].end + bus::kSynBits * kBit);
  EXPECT_EQ(flags_, (std::vector<bus::FlagKind>{bus::FlagKind::kUnanswered})) << "only the last request";
}

TEST_F(HostLineTest, AfterATelegramThatNobodyAnswersTSynIsEnough) {
  line_.send(100 * kBit, kUnanswered);
  line_.send(100 * kBit, kRequest);
  timeline_.run_until(1000 * kBit);
  ASSERT_EQ(heard_.size(), 2U);
  EXPECT_EQ(heard_[1].start, heard_[0].end + bus::kSynBits * kBit);
}

TEST_F(HostLineTest, AnAnswerOfTheHostWaitsForMinTsdrOnly) {
  send(100 * kBit, kRequest);
  line_.send(timeline_.now(), kAnswer);
  timeline_.run_until(1000 * kBit);
  ASSERT_EQ(heard_.size(), 2U);
  EXPECT_EQ(heard_[1].start, heard_[0].end + bus::kMinTsdrBits * kBit);
  EXPECT_TRUE(flags_.empty());
}

TEST_F(HostLineTest, AnAnswerOfTheHostThatIsLateHasNoTimeOfItsStation) {
  monitor_.untimed = [this](Tick start) { return line_.began_at(start); };
  send(100 * kBit, kRequest);
  const Tick asked = timeline_.now();
  line_.send(asked + 90 * kBit, kAnswer);
  timeline_.run_until(1000 * kBit);
  ASSERT_EQ(heard_.size(), 2U);
  EXPECT_EQ(heard_[1].station, 8) << "an answer to the request";
  EXPECT_FALSE(heard_[1].tsdr);
  EXPECT_TRUE(flags_.empty());
}

TEST_F(HostLineTest, ACharacterThatCameWithWrongParityHasItOnTheSegmentToo) {
  line_.send(100 * kBit, kRequest, 3);
  timeline_.run_until(1000 * kBit);
  ASSERT_EQ(heard_.size(), 1U);
  EXPECT_TRUE(heard_[0].character_errors);
  EXPECT_EQ(flags_.at(0), bus::FlagKind::kCharacterError);
}

TEST_F(HostLineTest, AnAnswerIsOwedUntilItIsTakenOrTheSlotTimeIsOver) {
  const auto owes = [this] { return line_.owes_answer(timeline_.now()); };
  EXPECT_TRUE(line_.send(100 * kBit, kRequest));
  EXPECT_TRUE(owes()) << "it waits";
  timeline_.run_until(170 * kBit);
  EXPECT_TRUE(owes());
  send(177 * kBit, kAnswer);
  timeline_.run_until(timeline_.now() + 12 * kBit);
  EXPECT_TRUE(owes()) << "not taken yet";
  line_.take_heard(timeline_.now(), false);
  EXPECT_FALSE(owes());
  EXPECT_TRUE(line_.send(timeline_.now(), kRequest));
  timeline_.run_until(timeline_.now() + (33 + 66 + 300) * kBit);
  EXPECT_FALSE(owes()) << "nobody answered";
  EXPECT_FALSE(line_.send(timeline_.now(), kUnanswered));
  EXPECT_FALSE(owes());
  EXPECT_TRUE(line_.send(timeline_.now(), kRequest));
  line_.forget();
  EXPECT_FALSE(owes()) << "its host has hung up";
}

TEST_F(HostLineTest, TheHostHearsOthersAndNotItself) {
  line_.send(100 * kBit, kRequest);
  timeline_.run_until(170 * kBit);
  EXPECT_TRUE(line_.take_heard(timeline_.now(), false).empty());
  EXPECT_TRUE(line_.busy(timeline_.now())) << "an answer is awaited";
  send(177 * kBit, kAnswer);
  EXPECT_TRUE(line_.take_heard(timeline_.now(), true).empty()) << "more might follow";
  timeline_.run_until(timeline_.now() + 3 * kBit);
  EXPECT_EQ(line_.take_heard(timeline_.now(), true), kAnswer);
  EXPECT_FALSE(line_.busy(timeline_.now()));
  EXPECT_EQ(line_.statistics().heard_bytes, kAnswer.size());
}

TEST_F(HostLineTest, BytesThatAreNoTelegramAreSentAsTheyAre) {
  line_.send(100 * kBit, {0x00, 0xFF, 0x55});
  timeline_.run_until(1000 * kBit);
  EXPECT_EQ(line_.statistics().sent_bytes, 3U);
  EXPECT_FALSE(flags_.empty());
}

TEST_F(HostLineTest, WhatWaitsOfAHostThatHungUpIsSentForNobody) {
  for (int i = 0; i < 3; ++i) line_.send(100 * kBit, kRequest);
  timeline_.run_until(110 * kBit);
  EXPECT_EQ(line_.waiting_bytes(), 2 * kRequest.size());
  line_.forget();
  line_.send(timeline_.now(), kRequest);  // of the next host
  for (std::size_t sent = 1; sent < 5; ++sent) {
    while (heard_.size() < sent) timeline_.run_until(timeline_.now() + kBit);
    EXPECT_TRUE(heard_[sent - 1].right());
    send(heard_[sent - 1].end + 11 * kBit, kAnswer);
    timeline_.run_until(timeline_.now() + 12 * kBit);
    heard_.pop_back();  // the answer
    EXPECT_EQ(line_.take_heard(timeline_.now(), false), sent < 4 ? Bytes() : kAnswer) << sent;
  }
  EXPECT_EQ(line_.waiting_bytes(), 0U);
}

TEST_F(HostLineTest, TheAnswerToAHostThatHungUpIsForNobody) {
  line_.send(100 * kBit, kRequest);
  timeline_.run_until(170 * kBit);
  line_.forget();
  send(177 * kBit, kAnswer);
  timeline_.run_until(timeline_.now() + 12 * kBit);
  EXPECT_TRUE(line_.take_heard(timeline_.now(), false).empty());
  send(timeline_.now() + 40 * kBit, kUnanswered);
  timeline_.run_until(timeline_.now() + 12 * kBit);
  EXPECT_EQ(line_.take_heard(timeline_.now(), false), kUnanswered) << "what others send after T_SYN is heard again";
}

TEST_F(HostLineTest, TheNextHostHearsTheAnswerToItsOwnRequest) {
  line_.send(100 * kBit, kRequest);
  timeline_.run_until(170 * kBit);
  line_.forget();
  line_.send(timeline_.now(), kRequest);
  while (heard_.size() < 2) timeline_.run_until(timeline_.now() + kBit);
  send(heard_[1].end + 11 * kBit, kAnswer);
  timeline_.run_until(timeline_.now() + 12 * kBit);
  EXPECT_EQ(line_.take_heard(timeline_.now(), false), kAnswer);
}

TEST_F(HostLineTest, ALineThatNeverFallsSilentIsHandedOverInPieces) {
  const std::size_t most = tb::serve::HostLine::kMostWhole;
  send(100 * kBit, Bytes(most - 1, 0x00));
  timeline_.run_until(timeline_.now() + kBit);
  EXPECT_TRUE(line_.take_heard(timeline_.now(), true).empty()) << "more might follow";
  send(timeline_.now(), {0x00});
  timeline_.run_until(timeline_.now() + kBit);
  EXPECT_EQ(line_.take_heard(timeline_.now(), true).size(), most);
}

}  // namespace
}  // namespace dsdpv1

// The C2 timers over times too long for a bench of whole chips (V12; 16 bit, unit 10 ms: table 33).
#include "model/profibus/msac2.hpp"

#include <gtest/gtest.h>

#include "tests/core/event_recorder.hpp"

namespace dsdpv1::profibus {
namespace {

constexpr Cycle kUnit = 480'000;

class Msac2Block : public testing::Test {
 protected:
  /// A master gets a channel at cycle `now`.
  void initiate(Cycle now, int send_timeout) {
    const std::uint8_t initiate[14] = {
        0x57, 0, 0, 0, static_cast<std::uint8_t>(send_timeout >> 8), static_cast<std::uint8_t>(send_timeout & 0xFF), 1};
    Request request = to(49);
    request.data = initiate;
    request.size = sizeof initiate;
    ASSERT_EQ(msac2.initiate(now, request).kind, Reply::Kind::kData);
  }
  /// And is connected.
  void connect(Cycle now, int send_timeout) {
    initiate(now, send_timeout);
    ASSERT_EQ(msac2.handle(now, to(48)).kind, Reply::Kind::kData);
  }
  static Request to(int sap) {
    Request request;
    request.sa = 1;
    request.dsap = sap;
    request.ssap = 50;
    return request;
  }
  core_test::EventRecorder recorder;
  AcyclicMail mail;
  Msac2 msac2{recorder.log, kMaxAcyclic, mail};
};

TEST_F(Msac2Block, IEndsAtTwiceTheSendTimeout) {
  for (const int units : {1, 2, 100, 0x7FFF}) {
    msac2.reset();
    connect(1000, units);
    EXPECT_EQ(msac2.next(), 1000 + 2 * units * kUnit) << units;
  }
}

TEST_F(Msac2Block, IStopsAtSixteenBits) {
  for (const int units : {0x8000, 0xFFFF}) {
    msac2.reset();
    connect(1000, units);
    EXPECT_EQ(msac2.next(), 1000 + 0xFFFF * kUnit) << units;
  }
}

TEST_F(Msac2Block, FAndUTakeTheWholeSendTimeout) {
  initiate(1000, 0xFFFF);
  EXPECT_EQ(msac2.next(), 1000 + 0xFFFF * kUnit) << "F alone";
  msac2.reset();
  connect(1000, 0xFFFF);
  const std::uint8_t read[4] = {0x5E, 1, 1, 1};
  Request request = to(48);
  request.data = read;
  request.size = sizeof read;
  ASSERT_EQ(msac2.handle(2000, request).kind, Reply::Kind::kShort);
  EXPECT_EQ(msac2.next(), 2000 + 0xFFFF * kUnit);
  ASSERT_EQ(msac2.handle(3000, to(48)).kind, Reply::Kind::kShort);
  EXPECT_EQ(msac2.next(), 2000 + 0xFFFF * kUnit) << "the poll has started F again: this is U alone";
}

TEST_F(Msac2Block, FIsReportedWhenItEndsTogetherWithU) {
  connect(1000, 1);
  const std::uint8_t read[4] = {0x5E, 1, 1, 1};
  Request request = to(48);
  request.data = read;
  request.size = sizeof read;
  msac2.handle(2000, request);
  msac2.eval(2000 + kUnit);
  ASSERT_EQ(recorder.count(Reason::kC2Timeout), 1);
  for (const Event& event : recorder.events) EXPECT_TRUE(event.reason != Reason::kC2Timeout || event.b == 1);
}

TEST_F(Msac2Block, RestsWhileNoChannelIsInUse) {
  EXPECT_EQ(msac2.next(), kNever);
  connect(1000, 1);
  const std::uint8_t abort[3] = {0x58, 0, 0};
  Request request = to(48);
  request.data = abort;
  request.size = sizeof abort;
  ASSERT_EQ(msac2.handle(2000, request).kind, Reply::Kind::kShort);
  EXPECT_EQ(msac2.next(), kNever) << "free again";
}

}  // namespace
}  // namespace dsdpv1::profibus

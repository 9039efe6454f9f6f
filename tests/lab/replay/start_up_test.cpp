// How the model is brought into the data exchange in which a capture begins.
#include "lab/replay/start_up.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lab/replay/captures.hpp"

namespace dsdpv1::replay_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

namespace sap = bus::sap;

Telegram with_fcb(Telegram telegram, bool fcb) {
  telegram.fc = static_cast<std::uint8_t>(telegram.fc | bus::fc::kFcv | (fcb ? bus::fc::kFcb : 0));
  return telegram;
}

Capture exchange_of(const Bytes& out, const Bytes& in, bool fcb = false) {
  Capture capture;
  capture.add(with_fcb(outputs(out), fcb));
  capture.add(inputs(in));
  return capture;
}

TEST(StartUp, IsOfTheMasterOfTheExchange) {
  Capture capture = exchange_of({1, 2}, {3});
  user_cpu::StationConfig station;
  station.ident = 0x1234;
  station.cfg = {0x31};
  const auto telegrams = tb::replay::start_up_of(capture.finish(), station);
  ASSERT_THAT(telegrams, SizeIs(3));
  for (const Telegram& each : telegrams) {
    EXPECT_EQ(each.sa, kMaster);
    EXPECT_EQ(each.da, kSlave);
  }
  EXPECT_EQ(telegrams[0].dsap, sap::kSetPrm);
  EXPECT_EQ(telegrams[0].data, (Bytes{0xB0, 0, 0, 11, 0x12, 0x34, 0}));
  EXPECT_EQ(telegrams[1].dsap, sap::kChkCfg);
  EXPECT_EQ(telegrams[1].data, Bytes{0x31});
  EXPECT_EQ(telegrams[2].data, (Bytes{1, 2}));
}

TEST(StartUp, ItsLastFrameCountBitIsNotTheCapturesFirst) {
  for (const bool fcb : {false, true}) {
    Capture capture = exchange_of({1}, {3}, fcb);
    const Telegram last = tb::replay::start_up_of(capture.finish(), {}).back();
    EXPECT_EQ((last.fc & bus::fc::kFcb) != 0, !fcb);
    EXPECT_NE(last.fc & bus::fc::kFcv, 0);
  }
}

TEST(StartUp, WatchdogAndDpv1AsTheCaptureShowsThem) {
  Capture capture = exchange_of({1}, {3});
  capture.add(to_slave(sap::kSlaveDiag));
  capture.add(from_slave(sap::kSlaveDiag, {0, 0x0C, 0, kMaster, 0, 0}));
  user_cpu::StationConfig station;
  station.dpv1 = true;
  const Bytes prm = tb::replay::start_up_of(capture.finish(), station).front().data;
  EXPECT_THAT(prm, SizeIs(10));
  EXPECT_EQ(prm[0] & 0x08, 0x08);
  EXPECT_EQ(prm[1], 0xFF);
  EXPECT_EQ(prm[7], 0x80);
}

TEST(StartUp, ThereIsNoneWhereTheCaptureHasOne) {
  Capture capture;
  capture.add(to_slave(sap::kSetPrm, {0x80, 0, 0, 11, 0x12, 0x34, 0}));
  capture.add(bus::make_sc());
  capture.add(outputs({1}));
  capture.add(inputs({1}));
  EXPECT_THAT(tb::replay::start_up_of(capture.finish(), {}), IsEmpty());
}

TEST(StartUp, ConfigurationHasTheBytesOfTheExchange) {
  EXPECT_THAT(tb::replay::cfg_of_exchange(exchange_of(Bytes(2), Bytes(65)).finish()),
              ElementsAre(0x80, 1, 0x40, 63, 0x40, 0));
  Capture without_inputs;
  without_inputs.add(outputs({1}));
  without_inputs.add(bus::make_sc());
  EXPECT_THAT(tb::replay::cfg_of_exchange(without_inputs.finish()), ElementsAre(0x80, 0));
}

}  // namespace
}  // namespace dsdpv1::replay_test

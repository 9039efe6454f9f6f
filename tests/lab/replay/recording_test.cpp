// The sender of each telegram of a capture.
#include "lab/replay/recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/input/input_error.hpp"
#include "tests/lab/replay/captures.hpp"

namespace dsdpv1::replay_test {
namespace {

using tb::replay::Recording;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<bool> of_slave(const Recording& recording) {
  std::vector<bool> result;
  for (const auto& each : recording.telegrams) result.push_back(each.of_slave);
  return result;
}

std::string why_not(Capture& capture) {
  try {
    capture.finish();
  } catch (const tb::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Recording, ShortAcknowledgeIsOfWhoWasAsked) {
  Capture capture;
  capture.add(to_slave(bus::sap::kSetPrm, Bytes(7)));
  capture.add(bus::make_sc());
  capture.add(bus::make_telegram(9, kMaster, bus::fc::kRequest | bus::fc::kSrdHigh, {1}));
  capture.add(bus::make_sc());
  const Recording recording = capture.finish();
  EXPECT_THAT(of_slave(recording), ElementsAre(false, true, false, false));
  ASSERT_EQ(recording.requests.size(), 1U);
  EXPECT_EQ(recording.requests[0].answer, 1U);
}

TEST(Recording, AnswersByAddressAlsoWhenNobodyHasAsked) {
  Capture capture;
  capture.add(outputs({1}));
  capture.add(bus::make_telegram(kMaster, 9, bus::fc::kDl, {7}));
  capture.add(inputs({1}));
  capture.add(outputs({1}));
  capture.add(inputs({1}));
  const Recording recording = capture.finish();
  EXPECT_THAT(of_slave(recording), ElementsAre(false, false, true, false, true));
  EXPECT_FALSE(recording.requests[0].answer);
  EXPECT_EQ(recording.requests[1].answer, 4U);
}

TEST(Recording, WhatComesDamagedWithinTheSlotTimeIsTheSlaves) {
  Capture capture;
  capture.add(outputs({1}));
  capture.add({0x68, 0x04, 0x04}, 12, bus::capture::damage::kShort);
  capture.add(outputs({1}));
  capture.add({0x68, 0x04, 0x04}, bus::baud(kBaud).slot_bits, bus::capture::damage::kShort);
  const Recording recording = capture.finish();
  EXPECT_THAT(of_slave(recording), ElementsAre(false, true, false, false));
  EXPECT_FALSE(recording.answer(recording.requests[0])->right());
}

TEST(Recording, RequestsThatWantNoAnswerAreNone) {
  Capture capture;
  capture.add(bus::make_telegram(bus::kBroadcast, kMaster, bus::fc::kRequest | bus::fc::kSdnHigh, {0, 0},
                                 bus::sap::kGlobalControl, bus::sap::kMaster));
  capture.add(bus::make_token(kMaster, kMaster));
  capture.add(outputs({1}));
  capture.add(inputs({1}));
  EXPECT_EQ(capture.finish().requests.size(), 1U);
}

TEST(Recording, FollowsTheSlaveToItsNewAddress) {
  Capture capture(126);
  capture.add(bus::make_telegram(126, kMaster, bus::fc::kRequest | bus::fc::kSrdHigh, {kSlave, 0x12, 0x34, 0},
                                 bus::sap::kSetSlaveAddress, bus::sap::kMaster));
  capture.add(bus::make_sc());
  capture.add(outputs({1}));
  capture.add(inputs({2}));
  const Recording recording = capture.finish();
  EXPECT_THAT(of_slave(recording), ElementsAre(false, true, false, true));
  EXPECT_EQ(recording.requests.size(), 2U);
}

TEST(Recording, NamesTheStationsThatAnswer) {
  Capture capture(7);
  capture.add(outputs({1}));
  capture.add(inputs({1}));
  EXPECT_THAT(why_not(capture),
              HasSubstr("made.pcapng: no request to station 7 (--as), expected the stations that answer: 5"));
}

TEST(Recording, ASilentSlaveCannotBePlayed) {
  Capture capture;
  capture.add(outputs({1}));
  EXPECT_THAT(
      why_not(capture),
      HasSubstr("station 5 (--as) never answers, and nobody else answers, expected a capture with a slave that does"));
}

TEST(Recording, FollowsTheRateThatTheSlaveHasFound) {
  Capture capture;
  const auto exchange = [&capture](bool answered) {
    capture.add(outputs({1}));
    if (answered) capture.add(inputs({1}));
  };
  exchange(true);
  exchange(false);
  capture.set_baud(0);
  exchange(false);
  exchange(true);
  exchange(true);
  const Recording recording = capture.finish();
  EXPECT_EQ(recording.baud, kBaud);
  EXPECT_THAT(recording.bauds(), ElementsAre(kBaud, 0));
  std::vector<int> searching, found;
  for (const auto& each : recording.requests) {
    searching.push_back(each.searching ? 1 : 0);
    found.push_back(each.found ? 1 : 0);
  }
  EXPECT_THAT(searching, ElementsAre(0, 0, 1, 0, 0));
  EXPECT_THAT(found, ElementsAre(0, 0, 0, 1, 0));
}

TEST(Recording, ResolutionIsTheLargestUnitOfAllStarts) {
  tb::replay::Recorder recorder("made.pcap", kSlave, kBaud);
  for (int i = 0; i < 2; ++i) {
    bus::capture::CapturedTelegram telegram;
    telegram.start = telegram.end = (i * 70 + 30) * bus::kTicksPerUs;
    telegram.bytes = bus::encode(i == 0 ? outputs({1}) : inputs({1}));
    recorder.telegram(telegram);
  }
  EXPECT_EQ(recorder.finish().resolution, 10 * bus::kTicksPerUs);
}

}  // namespace
}  // namespace dsdpv1::replay_test

// The line when a capture is played: all telegrams except the slave's.
#include "lab/replay/replayed_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bus/monitor/monitor.hpp"
#include "bus/wire/uart.hpp"
#include "tests/lab/replay/captures.hpp"

namespace dsdpv1::replay_test {
namespace {

using bus::Tick;
using tb::replay::place;
using tb::replay::Recording;
using testing::ElementsAre;
using testing::IsEmpty;

/// Keeps the changes of a segment.
struct Scope : bus::Listener {
  std::vector<tb::replay::LevelChange> changes;
  void line_changed(Tick at, bool level) override { changes.push_back({at, level}); }
};

/// The recording as levels of the line, as it was when it was sent.
void add_levels(Recording& recording) {
  bus::Segment segment;
  Scope scope;
  segment.attach("scope", &scope);
  bus::UartSender sender(segment, segment.attach("everybody", nullptr));
  sender.set_timing(bus::baud(kBaud).bit);
  for (const auto& telegram : recording.telegrams) {
    sender.send(telegram.start, bus::characters(telegram.bytes));
    while (sender.busy()) sender.run(sender.next());
  }
  recording.levels = scope.changes;
}

struct Heard {
  std::vector<Bytes> telegrams;
  std::vector<Tick> starts;
  std::vector<bus::FlagKind> flags;
};

/// The telegrams heard when it is played from `at` on.
Heard played(const Recording& recording, Tick at) {
  bus::Timeline timeline;
  bus::Segment segment;
  bus::Monitor monitor(segment);
  monitor.set_baud(recording.baud);
  Heard heard;
  monitor.on_telegram = [&heard](const bus::WireTelegram& each) {
    heard.telegrams.push_back(each.decoded.bytes);
    heard.starts.push_back(each.start);
    if (each.character_errors) heard.flags.push_back(bus::FlagKind::kCharacterError);
  };
  monitor.on_flag = [&heard](const bus::Flag& flag) {
    if (flag.kind != bus::FlagKind::kUnanswered && flag.kind != bus::FlagKind::kCharacterError)
      heard.flags.push_back(flag.kind);
  };
  const auto placed = place(recording);
  const auto line = tb::replay::make_line(segment, recording, placed);
  timeline.add(monitor);
  timeline.add(*line);
  line->begin(recording.telegrams.front().start, at);
  timeline.run_until(at + recording.end() + bus::kTicksPerMs);
  return heard;
}

Recording two_slaves() {
  Capture capture;
  capture.add(outputs({1, 2}));
  capture.add(inputs({3, 4}));
  capture.add(bus::make_telegram(9, kMaster, bus::fc::kRequest | bus::fc::kSrdHigh, {5}));
  capture.add(bus::make_telegram(kMaster, 9, bus::fc::kDl, {6}));
  return capture.finish();
}

void expect_others_only(const Recording& recording) {
  constexpr Tick kAt = 77 * bus::kTicksPerUs;
  const Heard heard = played(recording, kAt);
  const auto& all = recording.telegrams;
  EXPECT_THAT(heard.telegrams, ElementsAre(all[0].bytes, all[2].bytes, all[3].bytes));
  const Tick shift = kAt - all[0].start;
  EXPECT_THAT(heard.starts, ElementsAre(kAt, all[2].start + shift, all[3].start + shift));
  EXPECT_THAT(heard.flags, IsEmpty());
}

TEST(ReplayedLine, TelegramsOfOthersAreSentWhenTheyWere) { expect_others_only(two_slaves()); }

TEST(ReplayedLine, LevelsAreIdleWhereTheSlaveSent) {
  Recording recording = two_slaves();
  add_levels(recording);
  expect_others_only(recording);
}

TEST(ReplayedLine, LevelsAfterTheLastTelegramAreLeftOut) {
  Recording recording = two_slaves();
  add_levels(recording);
  recording.levels.push_back({recording.end() + 12, false});
  expect_others_only(recording);
}

TEST(ReplayedLine, SymbolErrorIsSentAsOne) {
  Capture capture;
  capture.add(outputs({1}));
  capture.add(inputs({1}));
  capture.add(bus::encode(outputs({2})), 40, bus::capture::damage::kCharacter);
  const Heard heard = played(capture.finish(), bus::kTicksPerMs);
  EXPECT_THAT(heard.flags, ElementsAre(bus::FlagKind::kCharacterError));
}

TEST(ReplayedLine, StopsAtTheTelegramWhoseRateTheSlaveHasFoundUntilItMayGoOn) {
  Capture capture;
  capture.add(outputs({1}));
  capture.add(inputs({1}));
  capture.set_baud(0);
  capture.add(outputs({2}));
  capture.add(outputs({3}));
  capture.add(inputs({3}));
  const Recording recording = capture.finish();
  bus::Timeline timeline;
  bus::Segment segment;
  bus::Monitor monitor(segment);
  monitor.set_baud(recording.baud);
  std::vector<Bytes> telegrams;
  std::vector<Tick> starts;
  monitor.on_telegram = [&](const bus::WireTelegram& each) {
    telegrams.push_back(each.decoded.bytes);
    starts.push_back(each.start);
  };
  const auto placed = place(recording);
  const auto line = tb::replay::make_line(segment, recording, placed);
  line->on_baud = [&monitor](int baud) { monitor.set_baud(baud); };
  std::vector<std::size_t> asked;
  line->may_go_on = [&asked](std::size_t at) {
    asked.push_back(at);
    return false;
  };
  timeline.add(monitor);
  timeline.add(*line);
  line->begin(placed[0].start, bus::kTicksPerMs);
  timeline.run_until(2 * bus::kTicksPerMs);
  EXPECT_THAT(telegrams, ElementsAre(recording.telegrams[0].bytes, recording.telegrams[2].bytes));
  constexpr Tick kAgain = 3 * bus::kTicksPerMs;
  line->begin(placed[2].start, kAgain);
  timeline.run_until(2 * kAgain);
  EXPECT_THAT(asked, ElementsAre(2));
  ASSERT_EQ(telegrams.size(), 3U);
  EXPECT_EQ(telegrams[2], recording.telegrams[3].bytes);
  EXPECT_EQ(starts[2], kAgain);
}

TEST(ReplayedLine, CoarseTimesDoNotMakeTelegramsOverlap) {
  Recording recording = two_slaves();
  recording.telegrams[3].start -= 20 * bus::baud(kBaud).bit;
  recording.telegrams[3].end -= 20 * bus::baud(kBaud).bit;
  const auto placed = place(recording);
  EXPECT_EQ(placed[2].start, placed[1].end);
  EXPECT_EQ(placed[2].end - placed[2].start, recording.telegrams[3].end - recording.telegrams[3].start);
}

}  // namespace
}  // namespace dsdpv1::replay_test

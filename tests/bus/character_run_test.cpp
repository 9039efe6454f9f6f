// Runs of characters: a listener that takes them as a whole sees the same as from single changes, even if they are cut
// at any tick.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "bus/master/fdl.hpp"
#include "bus/timeline.hpp"
#include "bus/wire/uart.hpp"

namespace dsdpv1::bus {
namespace {

constexpr Tick kRunBit = 1000, kRunStart = 10'000;

bool same(const std::vector<ReceivedCharacter>& a, const std::vector<ReceivedCharacter>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const ReceivedCharacter& x, const ReceivedCharacter& y) {
        return x.byte == y.byte && x.start == y.start && x.end == y.end && x.ok() == y.ok() && x.stop_ok == y.stop_ok;
      });
}

/// A station that sends, or receives and counts.
struct RunStation : Listener, Agent {
  RunStation(Segment& segment, Timeline& timeline, bool takes)
      : takes_runs(takes), sender(segment, segment.attach("station", this)) {
    sender.set_timing(kRunBit);
    receiver.set_bit(kRunBit);
    receiver.on_character = [this](const ReceivedCharacter& character) { got.push_back(character); };
    receiver.on_false_start = [this](Tick at) { false_starts.push_back(at); };
    timeline.add(*this);
  }
  void send(Tick start, const Bytes& bytes) {
    announce();
    sender.send(start, characters(bytes));
  }
  void line_changed(Tick at, bool level) override {
    announce();
    ++changes;
    if (!sender.busy()) receiver.line_changed(at, level);
  }
  bool run_begins(const CharacterRun& run) override {
    announce();
    return takes_runs && (sender.busy() || receiver.set_run(run));
  }
  void run_cut(Tick at, bool level) override {
    announce();
    cut = level;
    sender.run_cut(at);
    receiver.cut_run(at);
  }
  Tick next() const override { return std::min(sender.next(), receiver.next()); }
  void run(Tick now) override {
    sender.run(now);
    receiver.run(now);
  }

  const bool takes_runs;
  UartSender sender;
  UartReceiver receiver;
  std::vector<ReceivedCharacter> got;
  std::vector<Tick> false_starts;
  int changes = 0;
  std::optional<bool> cut;
};

/// Drives the line low for a while.
struct Jammer : Agent {
  Jammer(Segment& line, Timeline& timeline) : segment(line), station(line.attach("jammer", nullptr)) {
    timeline.add(*this);
  }
  Tick next() const override { return jams ? end : begin; }
  void run(Tick now) override {
    segment.drive(station, now, !jams, jams);
    if (jams) begin = end = kNever;
    jams = !jams;
  }
  Segment& segment;
  StationId station;
  Tick begin = kNever, end = kNever;
  bool jams = false;
};

struct RunBench {
  explicit RunBench(bool takes_runs, bool third_wants_changes = false)
      : sends(segment, timeline, takes_runs),
        hears(segment, timeline, takes_runs),
        third(segment, timeline, !third_wants_changes && takes_runs) {}
  void send(const Bytes& bytes) { sends.send(kRunStart, bytes); }
  void run() { timeline.run_until(sends.sender.end() + 100 * kRunBit); }

  Segment segment;
  Timeline timeline;
  RunStation sends, hears, third;
  Jammer jammer{segment, timeline};
};

const Bytes kRunBytes = {0x10, 0x00, 0xFF, 0x5A};

TEST(CharacterRun, LevelIsThatOfTheFrames) {
  const CharacterRun run{kRunStart, kRunBit, kRunBytes.data(), kRunBytes.size()};
  for (std::size_t i = 0; i < kRunBytes.size(); ++i) {
    for (int bit = 0; bit < kCharacterBits; ++bit) {
      const Tick begin = run.character(i) + bit * kRunBit;
      const bool level = ((Character::of(kRunBytes[i]).bits >> bit) & 1) != 0;
      EXPECT_EQ(run.level(begin), level);
      EXPECT_EQ(run.level(begin + kRunBit - 1), level);
    }
  }
  EXPECT_TRUE(run.level(run.end()));
}

TEST(CharacterRun, IsHeardWithoutAnyChange) {
  RunBench bench(true), changes(false);
  for (RunBench* each : {&bench, &changes}) {
    each->send(kRunBytes);
    each->run();
  }
  EXPECT_EQ(bench.hears.changes, 0);
  EXPECT_GT(changes.hears.changes, 0);
  ASSERT_EQ(bench.hears.got.size(), kRunBytes.size());
  EXPECT_TRUE(same(bench.hears.got, changes.hears.got));
  EXPECT_FALSE(bench.hears.cut);
}

TEST(CharacterRun, WhoWantsTheChangesIsToldThem) {
  RunBench bench(true, true);
  bench.send(kRunBytes);
  bench.run();
  EXPECT_EQ(bench.hears.changes, 0);
  EXPECT_GT(bench.third.changes, 0);
  EXPECT_TRUE(same(bench.third.got, bench.hears.got));
}

TEST(CharacterRun, OneFollowsTheOther) {
  RunBench bench(true);
  bench.send(kRunBytes);
  bench.run();
  const Tick again = bench.timeline.now() + 1;
  bench.sends.send(again, {0x33});
  bench.timeline.run_until(again + 20 * kRunBit);
  ASSERT_EQ(bench.hears.got.size(), kRunBytes.size() + 1);
  EXPECT_EQ(bench.hears.got.back().start, again);
  EXPECT_EQ(bench.hears.changes, 0);
}

TEST(CharacterRun, BrokenCharactersAndAWrongClockAreSentByChanges) {
  WireFaults faults;
  faults.wrong_parity_at = 1;
  RunBench broken(true), slow(true);
  broken.sends.sender.send(kRunStart, characters(kRunBytes, faults));
  slow.sends.sender.set_timing(kRunBit, 100);
  slow.send(kRunBytes);
  for (RunBench* each : {&broken, &slow}) {
    each->run();
    EXPECT_GT(each->hears.changes, 0);
  }
}

class RunCut : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(OneWantsChanges, RunCut, testing::Bool());

TEST_P(RunCut, AtAnyTickIsHeardAsTheChangesAre) {
  const Tick end = kRunStart + static_cast<Tick>(kRunBytes.size()) * kCharacterBits * kRunBit;
  int cuts = 0;
  for (Tick at = kRunStart - 2 * kRunBit; at < end + 2 * kRunBit; at += kRunBit / 4) {
    RunBench bench(true, GetParam()), changes(false);
    for (RunBench* each : {&bench, &changes}) {
      each->jammer.begin = at;
      each->jammer.end = at + 2 * kRunBit + kRunBit / 4;
      each->send(kRunBytes);
      each->run();
    }
    EXPECT_TRUE(same(bench.hears.got, changes.hears.got)) << at;
    EXPECT_TRUE(same(bench.third.got, changes.third.got)) << at;
    EXPECT_EQ(bench.hears.false_starts, changes.hears.false_starts) << at;
    EXPECT_EQ(bench.segment.level(), changes.segment.level()) << at;
    cuts += bench.hears.cut ? 1 : 0;
  }
  EXPECT_GE(cuts, 4 * 44 - 1);
}

TEST(CharacterRun, IsCutByWhateverElseHappensToTheLine) {
  const auto cut_by = [](const std::function<void(RunBench&)>& disturb) {
    RunBench bench(true);
    bench.send({0x00});
    bench.timeline.run_until(kRunStart + 2 * kRunBit);
    disturb(bench);
    return bench.hears.cut;
  };
  constexpr Tick kNow = kRunStart + 2 * kRunBit;
  EXPECT_EQ(cut_by([](RunBench& bench) { bench.segment.force(kNow, true); }), false);
  EXPECT_EQ(cut_by([](RunBench& bench) { bench.segment.plug(2, kNow, false); }), false);
  EXPECT_EQ(cut_by([](RunBench& bench) { bench.segment.drive(2, kNow, true, true); }), false);
  EXPECT_EQ(cut_by([](RunBench& bench) { bench.sends.sender.abort(kNow); }), false);
  EXPECT_EQ(cut_by([](RunBench&) {}), std::nullopt);
}

// A master that changes its rate while another station sends receives the rest at the new one, as invalid characters.
TEST(CharacterRun, IsCutByAMasterThatChangesItsRate) {
  for (const bool takes_runs : {false, true}) {
    RunBench bench(takes_runs);
    MasterFdl fdl(bench.segment, "master", 1, {});
    std::vector<Telegram> heard;
    fdl.on_heard = [&heard](const HeardTelegram& telegram) { heard.push_back(telegram.telegram); };
    bench.send(encode(make_telegram(3, 2, fc::kRequest | fc::kFdlStatus)));
    const Tick change = kRunStart + 20 * kRunBit;
    bench.timeline.run_until(change);
    fdl.set_baud(change, 1);
    bench.run();
    fdl.run(bench.timeline.now());
    EXPECT_TRUE(heard.empty());
    EXPECT_EQ(bench.hears.cut.has_value(), takes_runs);
    EXPECT_EQ(bench.hears.got.size(), 6U);
  }
}

TEST(CharacterRun, ALineThatIsDisturbedIsToldChanges) {
  const auto changes_with = [](const std::function<void(RunBench&)>& disturb) {
    RunBench bench(true);
    disturb(bench);
    bench.send(kRunBytes);
    bench.timeline.run_until(kRunStart + 3 * kRunBit);
    return bench.hears.changes;
  };
  EXPECT_EQ(changes_with([](RunBench&) {}), 0);
  EXPECT_GT(changes_with([](RunBench& bench) { bench.segment.drive(2, 0, true, true); }), 0);
  EXPECT_EQ(changes_with([](RunBench& bench) { bench.segment.plug(2, 0, false); }), 0);
}

}  // namespace
}  // namespace dsdpv1::bus

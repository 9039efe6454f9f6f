// Data exchange, C1, C2 and alarms at once, with a host that is late, while telegrams and frames overlap.
#include <random>

#include "tests/core/event_recorder.hpp"
#include "tests/xgate/module_bench.hpp"

namespace dsdpv1::xgate {
namespace {

std::uint32_t number_of(const Bytes& bytes, std::size_t at = 0) {
  return static_cast<std::uint32_t>(bytes.at(at) << 16 | bytes.at(at + 1) << 8 | bytes.at(at + 2));
}
Bytes bytes_of(std::uint32_t number) {
  return {static_cast<std::uint8_t>(number >> 16 & 0xFF), static_cast<std::uint8_t>(number >> 8 & 0xFF),
          static_cast<std::uint8_t>(number & 0xFF)};
}
/// The data of a request, by its slot and index: both ends know them.
Bytes data_for(std::uint8_t slot, std::uint8_t index) { return {slot, index, static_cast<std::uint8_t>(slot ^ index)}; }

/// Sends the next command when the last answer is complete and a time has passed.
class LateHost {
 public:
  LateHost(ModuleBench& bench, Cycle latest) : bench_(bench), latest_(latest) {
    bench.on_heard = [this] { hear(); };
  }
  void begin() {
    bench_.heard.clear();
    send(frame(0x20, bytes_of(++inputs)));
  }

  std::uint32_t inputs = 0, outputs = 0;
  int requests = 0, raised = 0, acknowledged = 0, refused = 0, wrong = 0;

 private:
  void hear() {
    const Bytes& heard = bench_.heard;
    if (heard.size() < 5 || heard.size() != heard[2] + 5U) return;
    const Bytes answer = std::exchange(bench_.heard, Bytes());
    take(answer);
    send(next(answer));
  }
  void take(const Bytes& answer) {
    if ((answer[3] & 0x80) != 0) {
      const bool alarm = answer[1] == 0x31 && answer[4] == 4 && answer[5] == 3;
      (alarm ? refused : wrong)++;
      return;
    }
    if (asked_ == 0x31) ++raised;
    if (answer[1] == 0x30) return;
    wrong += number_of(answer, 4) < outputs ? 1 : 0;
    outputs = number_of(answer, 4);
  }
  Bytes next(const Bytes& answer) {
    std::uint8_t special = 0x11;
    if ((answer[3] & 0x40) != 0) {
      ++acknowledged;
      special = 0x51;
    }
    if (answer[1] == 0x30) return frame(0x30, answers(answer), special);
    if (answer[1] == 0x21 && asked_ != 0x21) return frame(0x21, bytes_of(++inputs), special);
    if (random_() % 4 != 0) return frame(0x20, bytes_of(++inputs), special);
    sequence_ = (sequence_ + 1) % 32;
    return frame(0x31, box(4, {0x04, 0x02, 1, static_cast<std::uint8_t>(sequence_ << 3)}), special);
  }
  /// To each request of a queue.
  Bytes answers(const Bytes& answer) {
    Bytes all;
    for (std::size_t at = 4; at + 1 < answer.size(); at += answer[at + 1] + 4U) {
      const std::uint8_t slot = answer[at + 4], index = answer[at + 5];
      all = all + box(answer[at], Bytes{answer[at + 3], slot, index, 3} + data_for(slot, index));
      ++requests;
    }
    return all;
  }
  void send(const Bytes& bytes) {
    asked_ = bytes[1];
    const Cycle heard = std::max(bench_.heard_until, bench_.now);
    bench_.put_later(heard + kByte + static_cast<Cycle>(random_() % static_cast<std::uint64_t>(latest_)), bytes);
  }

  ModuleBench& bench_;
  const Cycle latest_;
  std::mt19937_64 random_{7};
  unsigned sequence_ = 0;
  std::uint8_t asked_ = 0;
};

/// A class 1 master, and a class 2 master with the same address, in turn.
class Master {
 public:
  explicit Master(ModuleBench& bench) : bench_(bench) {}

  void connect() {
    bench_.service(49, {0x57, 0, 0, 0, 0x03, 0xE8, 1, 0, 0, 0, 0, 0, 0, 0}, 50);
    ASSERT_FALSE(bench_.poll(48, 50).empty());
  }
  void cycle() {
    const Bytes in = bench_.service(-1, bytes_of(++outputs));
    ASSERT_EQ(in.size(), 3U);
    EXPECT_GE(number_of(in), inputs);
    inputs = number_of(in);
    constexpr std::uint8_t kHigh = 0x0A;
    if (bench_.answered[6] == kHigh) alarms_.push_back(bench_.diagnosis());
    c1();
    talk(c2_, 48, 50);
  }

  std::uint32_t inputs = 0, outputs = 0;
  int answered = 0, acknowledged = 0;

 private:
  struct Talk {
    std::uint8_t slot = 0, index = 0;
    bool open = false;
  };

  /// An Alarm_Ack, or reads.
  void c1() {
    if (c1_.open || alarms_.empty()) return talk(c1_, 51, 51);
    const Bytes& alarm = alarms_.front();
    ASSERT_EQ(alarm.size(), 10U);
    const Bytes acknowledgement = {0x5C, alarm[8], alarm[7], alarm[9]};
    if (!acknowledges_) {
      bench_.service(51, acknowledgement, 51);
      acknowledges_ = true;
      return;
    }
    const Bytes answer = bench_.service(51, {}, 51);
    if (answer.empty()) return;
    EXPECT_EQ(answer, acknowledgement);
    ++acknowledged;
    acknowledges_ = false;
    alarms_.pop_front();
  }
  void talk(Talk& talk, int sap, int ssap) {
    if (!talk.open) {
      ++talk.slot;
      talk.index = static_cast<std::uint8_t>(talk.slot * 7);
      bench_.service(sap, {0x5E, talk.slot, talk.index, 3}, ssap);
      talk.open = true;
      return;
    }
    const Bytes answer = bench_.service(sap, {}, ssap);
    if (answer.empty()) return;
    EXPECT_EQ(answer, (Bytes{0x5E, talk.slot, talk.index, 3} + data_for(talk.slot, talk.index))) << sap;
    talk.open = false;
    ++answered;
  }

  ModuleBench& bench_;
  Talk c1_, c2_;
  std::deque<Bytes> alarms_;  ///< not acknowledged yet
  bool acknowledges_ = false;
};

struct Totals {
  int requests, answered, raised, acknowledged_master, acknowledged_host, refused, wrong;
  std::uint32_t inputs, outputs;
};

Totals load(ModuleBench& bench, Cycle latest, int cycles) {
  bench.to_exchange();
  Master master(bench);
  master.connect();
  LateHost host(bench, latest);
  host.begin();
  for (int i = 0; i < cycles && !testing::Test::HasFatalFailure(); ++i) master.cycle();
  bench.on_heard = nullptr;
  return {host.requests, master.answered, host.raised,   master.acknowledged, host.acknowledged,
          host.refused,  host.wrong,      master.inputs, host.outputs};
}

TEST(XgateLoad, NothingIsLostWithALateHost) {
  for (const Cycle latest : {Cycle{1}, Cycle{20'000}, Cycle{200'000}}) {
    ModuleBench bench;
    const Totals totals = load(bench, latest, 800);
    EXPECT_EQ(totals.wrong, 0) << latest;
    EXPECT_GT(totals.answered, 10) << latest;
    EXPECT_LE(totals.requests - totals.answered, 2) << "one of C1 and one of C2 are on their way";
    EXPECT_GE(totals.requests, totals.answered);
    EXPECT_GT(totals.raised, 4) << latest;
    EXPECT_LE(totals.raised - totals.acknowledged_master, 2) << "2 to the power of 1 are open at most";
    EXPECT_GT(totals.acknowledged_host, 3) << "one bit for all since it was cleared (X17)";
    EXPECT_LE(totals.acknowledged_host, totals.acknowledged_master);
    EXPECT_GT(totals.inputs, 15U);
    EXPECT_GT(totals.outputs, 500U);
  }
}

TEST(XgateLoad, TheSameAtEveryCycleAndWhenRestored) {
  ModuleBench skip(ModuleBench::quick(), Way::kSkip);
  load(skip, 5'000, 25);
  for (const Way way : {Way::kStep, Way::kRestored}) {
    ModuleBench other(ModuleBench::quick(), way);
    load(other, 5'000, 25);
    EXPECT_EQ(other.now, skip.now);
    EXPECT_TRUE(other.changes == skip.changes);
    EXPECT_EQ(other.begins, skip.begins);
    EXPECT_TRUE(
        std::equal(skip.events.begin(), skip.events.end(), other.events.begin(), other.events.end(), core_test::same));
  }
}

}  // namespace
}  // namespace dsdpv1::xgate

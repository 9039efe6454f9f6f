// Rulings S3, S10; chapter 7 of the micro-architecture.
#include "model/profibus/telegram_rx.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/core/event_recorder.hpp"

namespace dsdpv1::profibus {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes with_fcs(Bytes head, const Bytes& covered) {
  unsigned sum = 0;
  for (const std::uint8_t byte : covered) sum += byte;
  head.insert(head.end(), covered.begin(), covered.end());
  head.push_back(static_cast<std::uint8_t>(sum));
  head.push_back(sd::kEd);
  return head;
}

Bytes sd1() { return with_fcs({sd::kSd1}, {5, 2, 0x49}); }
Bytes sd2(const Bytes& data) {
  Bytes covered = {5, 2, 0x6D};
  covered.insert(covered.end(), data.begin(), data.end());
  const auto le = static_cast<std::uint8_t>(covered.size());
  return with_fcs({sd::kSd2, le, le, sd::kSd2}, covered);
}
Bytes sd3() { return with_fcs({sd::kSd3}, {5, 2, 0x6D, 1, 2, 3, 4, 5, 6, 7, 8}); }

/// A character on its way to the receiver, by its start edge.
struct Sent {
  Cycle start = 0, idle = 0;
  std::uint8_t value = 0;
  bool parity_ok = true, stop_ok = true;
};

/// A receiver fed with characters; `sparse`: evaluated only at next() and with characters.
struct Bench {
  explicit Bench(bool evaluate_sparsely) : rx(recorder.log), sparse(evaluate_sparsely) { rx.set_quiet(false); }

  void run(const std::vector<Sent>& line, int bit, Cycle until) {
    std::size_t i = 0;
    for (; now < until; ++now) {
      const bool complete = i < line.size() && now == line[i].start + bit / 2 + 10 * bit;
      if (complete) {
        const Sent& sent = line[i++];
        rx.character(now, {sent.start, sent.idle, sent.value, sent.parity_ok, sent.stop_ok}, bit);
      }
      const bool receiving = i < line.size() && now >= line[i].start;
      if (sparse && !complete && (receiving || now < rx.deadline())) continue;
      if (!rx.eval(now, receiving)) continue;
      decided.push_back(now);
      const Telegram& telegram = rx.telegram();
      Bytes seen = {telegram.sd, telegram.da, telegram.sa, telegram.fc, telegram.synced};
      for (int k = 0; k < telegram.size; ++k) seen.push_back(telegram.data[k]);
      telegrams.push_back(seen);
    }
  }

  core_test::EventRecorder recorder;
  TelegramRx rx;
  bool sparse;
  Cycle now = 0;
  std::vector<Cycle> decided;
  std::vector<Bytes> telegrams;
};

/// Appends characters without gaps, `idle` cycles after the last.
void append(std::vector<Sent>& line, const Bytes& bytes, int bit, Cycle idle) {
  for (const std::uint8_t byte : bytes) {
    const Cycle end = line.empty() ? 0 : line.back().start + 11 * bit;
    line.push_back({end + idle, idle, byte});
    idle = 0;
  }
}

TEST(TelegramRxBlock, RightTelegramsAreDecidedOneBitTimeAfterTheirEnd) {
  for (const int bit : {4, 8, 96}) {
    for (const Bytes& bytes :
         {sd1(), sd2({1}), sd2({1, 2}), sd2(Bytes(246, 7)), sd3(), Bytes{0xDC, 5, 2}, Bytes{0xE5}}) {
      std::vector<Sent> line;
      append(line, bytes, bit, 40 * bit);
      Bench bench(false);
      bench.run(line, bit, line.back().start + 20 * bit);
      ASSERT_EQ(bench.decided.size(), 1U) << int{bytes[0]};
      EXPECT_EQ(bench.decided[0], line.back().start + 12 * bit + 1);
      EXPECT_EQ(bench.rx.telegram().end, line.back().start + 11 * bit);
      EXPECT_EQ(bench.telegrams[0][0], bytes[0]);
      EXPECT_EQ(bench.telegrams[0][4], 1) << "synced";
    }
  }
}

TEST(TelegramRxBlock, SynIs33BitTimesLessOneCycle) {
  for (const Cycle idle : {33 * 4 - 2, 33 * 4 - 1, 33 * 4}) {
    std::vector<Sent> line;
    append(line, {0xE5}, 4, 200);
    append(line, sd1(), 4, idle);
    Bench bench(false);
    bench.run(line, 4, 3000);
    ASSERT_EQ(bench.telegrams.size(), 2U);
    EXPECT_EQ(bench.telegrams[1][4], idle >= 33 * 4 - 1 ? 1 : 0) << idle;
  }
}

TEST(TelegramRxBlock, AGapOfMoreThanOneBitVoids) {
  for (std::size_t before = 1; before < sd1().size(); ++before) {
    for (const Cycle gap : {4, 5}) {
      std::vector<Sent> line;
      const Bytes bytes = sd1();
      append(line, Bytes(bytes.begin(), bytes.begin() + static_cast<long>(before)), 4, 200);
      append(line, Bytes(bytes.begin() + static_cast<long>(before), bytes.end()), 4, gap);
      Bench bench(false);
      bench.run(line, 4, 3000);
      EXPECT_EQ(bench.telegrams.size(), gap <= 4 ? 1U : 0U) << "gap " << gap << " before character " << before;
    }
  }
}

TEST(TelegramRxBlock, EveryBitFlipVoidsOrIsAnotherLengthThatNeverFills) {
  for (const Bytes& right : {sd1(), sd2({1, 2, 3}), sd3()}) {
    for (std::size_t i = 0; i < right.size(); ++i) {
      for (int flipped = 0; flipped < 8; ++flipped) {
        Bytes bytes = right;
        bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ (1U << flipped));
        std::vector<Sent> line;
        append(line, bytes, 4, 200);
        Bench bench(false);
        bench.run(line, 4, 5000);
        EXPECT_TRUE(bench.telegrams.empty()) << "byte " << i;
        EXPECT_FALSE(bench.recorder.events.empty()) << "never without a reason, byte " << i << " bit " << flipped;
      }
    }
  }
}

TEST(TelegramRxBlock, ParityAndStopFaultsVoidAtEveryPosition) {
  for (std::size_t i = 0; i < sd1().size(); ++i) {
    for (const bool parity : {false, true}) {
      std::vector<Sent> line;
      append(line, sd1(), 4, 200);
      (parity ? line[i].parity_ok : line[i].stop_ok) = false;
      Bench bench(false);
      bench.run(line, 4, 3000);
      EXPECT_TRUE(bench.telegrams.empty());
      EXPECT_EQ(bench.recorder.count(parity ? Reason::kParity : Reason::kFraming), 1) << i;
    }
  }
}

TEST(TelegramRxBlock, AnotherCharacterBehindItMakesItOversized) {
  for (const Cycle idle : {0, 4}) {
    std::vector<Sent> line;
    append(line, sd1(), 4, 200);
    append(line, {0x00}, 4, idle);
    Bench bench(false);
    bench.run(line, 4, 3000);
    EXPECT_TRUE(bench.telegrams.empty());
    EXPECT_EQ(bench.recorder.count(Reason::kOversized), 1);
  }
}

TEST(TelegramRxBlock, EvaluatedOnlyAtNextItIsTheSame) {
  std::mt19937 random(17);
  for (const int bit : {4, 16}) {
    std::vector<Sent> line;
    for (int i = 0; i < 1500; ++i) {
      Bytes bytes;
      switch (random() % 6) {
        case 0: bytes = sd1(); break;
        case 1: bytes = sd2(Bytes(random() % 12, static_cast<std::uint8_t>(random()))); break;
        case 2: bytes = sd3(); break;
        case 3: bytes = {0xE5}; break;
        case 4: bytes = {0xDC, 1, 2}; break;
        default: bytes = Bytes(1 + random() % 9, static_cast<std::uint8_t>(random())); break;
      }
      if (random() % 4 == 0) bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
      if (random() % 6 == 0) bytes.resize(1 + random() % bytes.size());
      const std::size_t first = line.size();
      const bool synced = random() % 4 != 0;
      append(line, bytes, bit, (synced ? 33 * bit : 0) + static_cast<Cycle>(random() % static_cast<unsigned>(3 * bit)));
      if (random() % 8 == 0) line[first + random() % bytes.size()].parity_ok = false;
    }
    Bench every(false), sparse(true);
    const Cycle until = line.back().start + 100 * bit;
    every.run(line, bit, until);
    sparse.run(line, bit, until);
    EXPECT_EQ(every.decided, sparse.decided);
    EXPECT_EQ(every.telegrams, sparse.telegrams);
    ASSERT_EQ(every.recorder.events.size(), sparse.recorder.events.size());
    for (std::size_t i = 0; i < every.recorder.events.size(); ++i)
      ASSERT_TRUE(core_test::same(every.recorder.events[i], sparse.recorder.events[i]));
    EXPECT_GT(every.decided.size(), 200U);
  }
}

// --- faulty ones without T_SYN (S8)

/// Single characters with a wrong parity, each more than a gap and less than T_SYN after the last.
void feed_faulty(Bench& bench, int count) {
  constexpr int kBit = 4;
  for (int i = 0; i < count; ++i, bench.now += 100)
    bench.rx.character(bench.now, {bench.now - 42, 20, 0x10, false, true}, kBit);
}
/// The first character of a telegram with T_SYN before it.
void feed_synced(Bench& bench) { bench.rx.character(bench.now += 500, {bench.now - 42, 400, sd::kSd1, true, true}, 4); }

TEST(TelegramRxBlock, CountsFaultyOnesWithoutTSynAsFarAsAnEventGoes) {
  for (const auto& [faulty, told] :
       {std::pair(1, 1), {300, 300}, {65'535, 65'535}, {65'536, 65'535}, {70'000, 65'535}}) {
    Bench bench(false);
    feed_faulty(bench, faulty);
    EXPECT_TRUE(bench.recorder.events.empty());
    feed_synced(bench);
    feed_synced(bench);
    ASSERT_EQ(bench.recorder.events.size(), 1U) << "once";
    EXPECT_EQ(bench.recorder.events[0].reason, Reason::kFaultyUnsynced);
    EXPECT_EQ(bench.recorder.events[0].a, told);
  }
}

TEST(TelegramRxBlock, ForgetsWhatItCountedWhenTheSearchOrAResetComesFirst) {
  Bench bench(false);
  const auto told = [&bench] {
    const auto& events = bench.recorder.events;
    return std::count_if(events.begin(), events.end(),
                         [](const Event& e) { return e.reason == Reason::kFaultyUnsynced; });
  };
  feed_faulty(bench, 3);
  bench.rx.reset();
  feed_synced(bench);
  EXPECT_EQ(told(), 0);
  feed_faulty(bench, 3);
  bench.rx.set_quiet(true);
  feed_faulty(bench, 3);
  bench.rx.set_quiet(false);
  bench.rx.restart();
  feed_synced(bench);
  EXPECT_EQ(told(), 0);
  feed_faulty(bench, 3);
  bench.rx.restart();
  feed_synced(bench);
  EXPECT_EQ(told(), 1) << "an own answer forgets nothing";
}

}  // namespace
}  // namespace dsdpv1::profibus

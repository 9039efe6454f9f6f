// Rulings S2, S10; chapter 6 of the micro-architecture.
#include "model/profibus/uart_rx.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace dsdpv1::profibus {
namespace {

/// The levels of one character, bit by bit.
std::vector<bool> bits_of(std::uint8_t byte, bool good_parity = true, bool good_stop = true) {
  std::vector<bool> bits = {false};
  bool parity = false;
  for (unsigned i = 0; i < 8; ++i) {
    bits.push_back((byte >> i & 1) != 0);
    parity ^= bits.back();
  }
  bits.push_back(parity == good_parity);
  bits.push_back(good_stop);
  return bits;
}

struct Received {
  Cycle at = 0;
  Character character;
};

/// The logic sees `level` at the edge of `now`: the pin changed three edges before it (P9).
void see(UartRx& rx, Cycle now, bool level) { rx.set_line((now - 3) * kTicksPerCycle, level); }

/// Runs a receiver over a line given cycle by cycle.
std::vector<Received> receive(const std::vector<bool>& line, int bit) {
  UartRx rx;
  rx.restart(bit, 0, 0);
  std::vector<Received> found;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto now = static_cast<Cycle>(i);
    see(rx, now, line[i]);
    if (rx.eval(now)) found.push_back({now, rx.character()});
  }
  return found;
}

void append(std::vector<bool>& line, const std::vector<bool>& bits, int bit) {
  for (const bool level : bits) line.insert(line.end(), static_cast<std::size_t>(bit), level);
}

TEST(UartRxBlock, EveryByteAtEveryRateIsCompleteInTheMiddleOfItsStopBit) {
  for (const int bit : kBitCycles) {
    for (int byte = 0; byte<256; byte += bit> 100 ? 37 : 1) {
      std::vector<bool> line(100, true);
      append(line, bits_of(static_cast<std::uint8_t>(byte)), bit);
      line.insert(line.end(), 10, true);
      const std::vector<Received> found = receive(line, bit);
      ASSERT_EQ(found.size(), 1U);
      EXPECT_EQ(found[0].at, 100 + bit / 2 + 10 * bit);
      EXPECT_EQ(found[0].character.start, 100);
      EXPECT_EQ(found[0].character.idle, 100);
      EXPECT_EQ(found[0].character.value, byte);
      EXPECT_TRUE(found[0].character.parity_ok && found[0].character.stop_ok);
    }
  }
}

TEST(UartRxBlock, ParityAndStopFaultsAreTold) {
  for (int byte = 0; byte < 256; ++byte) {
    std::vector<bool> line(50, true);
    append(line, bits_of(static_cast<std::uint8_t>(byte), false), 4);
    line.insert(line.end(), 50, true);
    append(line, bits_of(static_cast<std::uint8_t>(byte), true, false), 4);
    line.insert(line.end(), 50, true);
    const std::vector<Received> found = receive(line, 4);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_FALSE(found[0].character.parity_ok);
    EXPECT_TRUE(found[0].character.stop_ok);
    EXPECT_TRUE(found[1].character.parity_ok);
    EXPECT_FALSE(found[1].character.stop_ok);
  }
}

TEST(UartRxBlock, IdleIsCountedFromTheCalculatedEndAndGlitchesDoNotEndIt) {
  std::vector<bool> line(40, true);
  append(line, bits_of(0x5A), 16);
  line.insert(line.end(), 100, true);
  line.insert(line.end(), 8, false);  // high again at mid-bit (8 cycles after the edge): no start
  line.insert(line.end(), 100, true);
  append(line, bits_of(0x5A), 16);
  line.insert(line.end(), 20, true);
  const std::vector<Received> found = receive(line, 16);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[1].character.idle, 208);
}

TEST(UartRxBlock, ALowPulseOneCycleLongerThanHalfABitIsAStart) {
  std::vector<bool> line(40, true);
  line.insert(line.end(), 9, false);
  line.insert(line.end(), 400, true);
  const std::vector<Received> found = receive(line, 16);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].character.value, 0xFF);
}

TEST(UartRxBlock, BackToBackCharactersHaveNoIdle) {
  std::vector<bool> line(40, true);
  for (int i = 0; i < 5; ++i) append(line, bits_of(static_cast<std::uint8_t>(i * 51)), 4);
  line.insert(line.end(), 20, true);
  const std::vector<Received> found = receive(line, 4);
  ASSERT_EQ(found.size(), 5U);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(found[i].character.idle, 0);
}

TEST(UartRxBlock, AfterABreakIdleCountsFromTheRise) {
  std::vector<bool> line(40, true);
  line.insert(line.end(), 200, false);
  line.insert(line.end(), 70, true);
  append(line, bits_of(0x33), 4);
  line.insert(line.end(), 20, true);
  const std::vector<Received> found = receive(line, 4);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_FALSE(found[0].character.stop_ok);
  EXPECT_EQ(found[1].character.idle, 70);
}

TEST(UartRxBlock, EvaluatedOnlyAtNextAndAtEdgesItIsTheSame) {
  std::mt19937 random(8);
  for (const int bit : {4, 8, 16, 96}) {
    std::vector<bool> line(30, true);
    while (line.size() < 60'000) {
      switch (random() % 4) {
        case 0: line.insert(line.end(), random() % 300, true); break;
        case 1: line.insert(line.end(), random() % static_cast<unsigned>(bit), false); break;
        case 2:
          append(line, bits_of(static_cast<std::uint8_t>(random()), random() % 8 != 0, random() % 8 != 0), bit);
          break;
        default: line.insert(line.end(), random() % 40, random() % 2 == 0); break;
      }
    }
    UartRx every, sparse;
    every.restart(bit, 0, 0);
    sparse.restart(bit, 0, 0);
    int complete = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto now = static_cast<Cycle>(i);
      if (sparse.full()) ASSERT_FALSE(sparse.eval(now - 1));
      see(every, now, line[i]);
      see(sparse, now, line[i]);
      const bool done = every.eval(now);
      const bool sparse_done = now >= sparse.next() && sparse.eval(now);
      ASSERT_EQ(done, sparse_done) << "cycle " << now;
      ASSERT_EQ(every.receiving(now), sparse.receiving(now)) << "cycle " << now;
      if (!done) continue;
      ++complete;
      ASSERT_EQ(every.character().value, sparse.character().value);
      ASSERT_EQ(every.character().idle, sparse.character().idle);
      ASSERT_EQ(every.character().start, sparse.character().start);
    }
    EXPECT_GT(complete, 10);
  }
}

// --- runs ------------------------------------------------------------------------------------------------------------

struct Told {
  Tick at;
  bool level;
};

/// The changes of a run.
std::vector<Told> changes_of(const CharacterRun& run) {
  std::vector<Told> changes;
  bool last = true;
  for (int i = 0; i < run.size * kBitsPerCharacter; ++i) {
    const unsigned frame = frame_of(run.bytes[i / kBitsPerCharacter]);
    const bool level = ((frame >> (i % kBitsPerCharacter)) & 1U) != 0;
    if (level != last) changes.push_back({run.start + i * run.bit * kTicksPerCycle, level});
    last = level;
  }
  return changes;
}

/// A receiver's result for a run that is cut at `cut`, from where the line is low for five bits.
class RunListener {
 public:
  RunListener(const CharacterRun& run, bool as_run, Tick cut) : run_(run), as_run_(as_run), cut_(cut) {
    for (const Told& change : changes_of(run))
      if (change.at <= cut && !as_run) told_.push_back(change);
    told_.push_back({cut, false});
    told_.push_back({cut + 5 * run.bit * kTicksPerCycle, true});
  }

  std::vector<Character> listen(bool at_once) {
    rx_.restart(static_cast<int>(run_.bit), 0, 0);
    if (as_run_) EXPECT_TRUE(rx_.set_run(run_, at_once));
    const Cycle end = (cut_ + 40 * run_.bit * kTicksPerCycle) / kTicksPerCycle;
    for (Cycle now = 1; now < end; ++now) {
      if (as_run_ && first_edge_after(cut_) == now) rx_.leave_run(cut_);
      for (; next_ < told_.size() && first_edge_after(told_[next_].at) == now; ++next_)
        rx_.set_line(told_[next_].at, told_[next_].level);
      while (rx_.eval(now)) found_.push_back(rx_.character());
    }
    return found_;
  }

 private:
  CharacterRun run_;
  bool as_run_;
  Tick cut_;
  UartRx rx_;
  std::vector<Told> told_;
  std::size_t next_ = 0;
  std::vector<Character> found_;
};

bool same(const std::vector<Character>& a, const std::vector<Character>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const Character& x, const Character& y) {
        return x.start == y.start && x.idle == y.idle && x.value == y.value && x.parity_ok == y.parity_ok &&
               x.stop_ok == y.stop_ok;
      });
}

TEST(UartRxBlock, RunCutAtAnyTickIsWhatItsChangesAre) {
  const std::vector<std::uint8_t> bytes = {0x68, 0x00, 0xFF, 0x35};
  for (const int bit : {4, 8}) {
    for (const Tick start : {Tick{50'000}, Tick{50'001}, Tick{50'249}}) {
      const CharacterRun run{start, bit, bytes.data(), static_cast<int>(bytes.size())};
      for (Tick cut = start; cut < start + 46 * bit * kTicksPerCycle; cut += 83) {
        const std::vector<Character> expected = RunListener(run, false, cut).listen(false);
        for (const bool at_once : {false, true})
          ASSERT_TRUE(same(RunListener(run, true, cut).listen(at_once), expected)) << bit << " " << start << " " << cut;
      }
    }
  }
}

TEST(UartRxBlock, RunThatIsHeardAtOnceHasOneNext) {
  const std::vector<std::uint8_t> bytes = {0x10, 0x05, 0x02};
  const CharacterRun run{50'000, 4, bytes.data(), 3};
  UartRx by_character, at_once;
  for (UartRx* rx : {&by_character, &at_once}) {
    rx->restart(4, 0, 0);
    ASSERT_TRUE(rx->set_run(run, rx == &at_once));
  }
  const Cycle first = 203 + 42;
  EXPECT_EQ(by_character.next(), first);
  EXPECT_EQ(at_once.next(), first + 2 * 44);
  int characters = 0;
  while (at_once.eval(first + 2 * 44)) EXPECT_EQ(at_once.completed(), first + 44 * characters++);
  EXPECT_EQ(characters, 3);
}

TEST(UartRxBlock, RunOfAnotherRateOrIntoACharacterIsRefused) {
  const std::uint8_t byte = 0;
  UartRx rx;
  rx.restart(4, 0, 0);
  EXPECT_FALSE(rx.set_run({50'000, 8, &byte, 1}, false));
  rx.set_line(40'000, false);
  EXPECT_FALSE(rx.set_run({50'000, 4, &byte, 1}, false));
}

TEST(UartRxBlock, RestartLeavesARunAndSaysSo) {
  const std::vector<std::uint8_t> bytes = {0x00, 0x55};
  const CharacterRun run{50'000, 4, bytes.data(), 2};
  UartRx rx;
  rx.restart(4, 0, 0);
  ASSERT_TRUE(rx.set_run(run, false));
  EXPECT_FALSE(rx.left_run());
  rx.restart(8, 210, 210);
  EXPECT_TRUE(rx.left_run());
  rx.forget_run();
  EXPECT_FALSE(rx.left_run());
}

}  // namespace
}  // namespace dsdpv1::profibus

// Skipped loop passes: the program sees the same values at the same times as without skipping.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "tests/board/processor_bench.hpp"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kDevice = 0x40001000;

/// A device that becomes 1 at a cycle; counts its reads.
class Device : public NotingSystem {
 public:
  std::uint32_t load(std::uint32_t address, unsigned bytes) override {
    if (address - kDevice >= 8) return NotingSystem::load(address, bytes);
    ++looks;
    last_look = processor->cycles();
    processor->advance_to(processor->cycles() + latency);
    if (stays && (address == kDevice || second_stays)) processor->stays(keep_up());
    return address == kDevice && processor->cycles() >= rises ? 1 : 0;
  }
  void store(std::uint32_t address, unsigned bytes, std::uint32_t value) override {
    if (address == kPort) noted_looks.push_back(last_look);
    NotingSystem::store(address, bytes, value);
  }
  void left_out(std::uint64_t since, std::uint64_t cycles) override {
    if (last_look > since) last_look += cycles;
  }
  std::uint64_t keep_up() override {
    const std::uint64_t next = NotingSystem::keep_up();
    return processor->cycles() < rises ? std::min(next, rises) : next;
  }
  std::uint64_t rises = 0, last_look = 0;
  std::vector<std::uint64_t> noted_looks;  ///< the last one before each note
  unsigned looks = 0, latency = 2;
  bool stays = true, second_stays = true;
};

struct Seen {
  std::vector<std::uint32_t> notes;
  std::vector<std::uint64_t> cycles, looks;
  std::uint64_t instructions;
  bool operator==(const Seen& other) const {
    return notes == other.notes && cycles == other.cycles && looks == other.looks && instructions == other.instructions;
  }
};
std::ostream& operator<<(std::ostream& out, const Seen& seen) {
  return out << testing::PrintToString(seen.notes) << testing::PrintToString(seen.cycles)
             << testing::PrintToString(seen.looks) << seen.instructions;
}

struct Wait {
  std::uint32_t way = 0;
  std::uint64_t rises = 0;
  std::uint64_t interrupt = 0;  ///< 0: none
  std::uint32_t millicycles = 0;
  bool stays = true, second_stays = true;
  unsigned irq = 0, latency = 2;
  std::uint32_t tick = 0;  ///< reload value of SysTick
};

Seen seen(const Wait& run, bool leaves_out, unsigned& looks) {
  Device system;
  Timing timing;
  timing.leaves_out_polls = leaves_out;
  timing.millicycles_per_instruction = run.millicycles;
  CortexM3 processor(system, MemoryMap{}, timing);
  system.processor = &processor;
  system.rises = run.rises;
  system.stays = run.stays;
  system.second_stays = run.second_stays;
  system.latency = run.latency;
  if (run.interrupt != 0) system.interrupts = {{run.interrupt, run.irq}};
  const std::vector<std::uint8_t> image = read_program("polls");
  processor.load(MemoryMap{}.flash_base, image.data(), image.size());
  std::memcpy(processor.ram() + 0x100, &run.way, sizeof run.way);
  std::memcpy(processor.ram() + 0x104, &run.tick, sizeof run.tick);
  processor.set_flash(2, true);
  processor.run();
  looks = system.looks;
  return {system.notes, system.note_cycles, system.noted_looks, processor.instructions()};
}

enum Way : std::uint32_t { kLook, kTwo, kMemory, kCounts, kStores, kBlock, kWorks, kCalls, kWide, kWays };

/// Number of reads without skipping, and with it.
std::pair<unsigned, unsigned> compare(const Wait& run) {
  unsigned all = 0, some = 0;
  const Seen expected = seen(run, false, all);
  EXPECT_EQ(seen(run, true, some), expected) << "way " << run.way << ", rises at " << run.rises << ", interrupt at "
                                             << run.interrupt << ", millicycles " << run.millicycles;
  return {all, some};
}

TEST(Polls, LeaveEverythingAsItIsWheneverTheDeviceChanges) {
  for (std::uint32_t way = 0; way < kWays; ++way)
    for (std::uint64_t rises = 400; rises < 500; ++rises)
      for (const unsigned latency : {0U, 2U}) compare({way, rises, 0, 0, true, true, 0, latency});
}

TEST(Polls, LeaveEverythingAsItIsWheneverAnInterruptComes) {
  for (std::uint32_t way = 0; way < kWays; ++way)
    for (std::uint64_t interrupt = 300; interrupt < 350; ++interrupt) {
      compare({way, 600, interrupt});
      compare({way, 600, interrupt, 0, true, true, 1});
    }
}

TEST(Polls, LeaveEverythingAsItIsWhileSysTickGoesOn) {
  for (std::uint32_t tick = 60; tick < 100; ++tick) compare({kLook, 3000, 0, 0, true, true, 0, 2, tick});
}

TEST(Polls, InterruptsComeAsIfNobodySaidThatALookStays) {
  unsigned looks = 0;
  for (std::uint64_t interrupt = 300; interrupt < 350; ++interrupt)
    EXPECT_EQ(seen({kLook, 600, interrupt}, true, looks), seen({kLook, 600, interrupt, 0, false}, true, looks))
        << interrupt;
}

TEST(Polls, LeaveEverythingAsItIsWhenInstructionsLastTheSame) {
  for (const std::uint32_t millicycles : {1000U, 1500U, 1333U})
    for (std::uint32_t way = 0; way < kWays; ++way)
      for (std::uint64_t rises = 900; rises < 920; ++rises) compare({way, rises, 700, millicycles});
}

TEST(Polls, AreLeftOutWhereEachPassIsLikeTheOneBefore) {
  for (const Way way : {kLook, kTwo, kMemory, kBlock, kWorks, kCalls, kWide}) {
    const auto [all, some] = compare({way, 100'000});
    EXPECT_GT(all, 700U) << way;
    EXPECT_LT(some, 20U) << way;
  }
  for (const Way way : {kCounts, kStores}) {
    const auto [all, some] = compare({way, 100'000});
    EXPECT_EQ(all, some) << way;
  }
}

TEST(Polls, AreMadeWhereTheSystemDoesNotSayThatItStays) {
  for (const Wait& run : {Wait{kLook, 100'000, 0, 0, false}, Wait{kTwo, 100'000, 0, 0, true, false}}) {
    const auto [all, some] = compare(run);
    EXPECT_EQ(all, some);
  }
}

}  // namespace
}  // namespace dsdpv1::arm

// Instructions, time, accesses and concurrent activity.
#include <gmock/gmock.h>

#include <memory>
#include <stdexcept>
#include <utility>

#include "tb/chip/user_cpu/fiber.hpp"
#include "tests/board/processor_bench.hpp"

namespace dsdpv1::arm {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;

class Execution : public ProcessorBench {};

TEST_F(Execution, CountsInstructionsAndCyclesOneByOne) {
  run("arithmetic");
  EXPECT_EQ(r(1), 55U);
  EXPECT_EQ(r(2), 2U);
  EXPECT_EQ(r(3), 3U);
  // 2 + 10 * 3, cmp, IT with three of which one fails, ldr, str
  EXPECT_EQ(processor.instructions(), 2 + 30 + 1 + 4 + 2U);
  EXPECT_EQ(processor.cycles(), processor.instructions());
  EXPECT_TRUE(faults.empty());
}

TEST(ExecutionTime, IsAMultipleOfThousandthsOfACycle) {
  NotingSystem system;
  Timing timing;
  timing.millicycles_per_instruction = 1500;
  CortexM3 processor(system, MemoryMap{}, timing);
  system.processor = &processor;
  const auto image = read_program("arithmetic");
  processor.load(0x08000000, image.data(), image.size());
  processor.run();
  EXPECT_EQ(processor.instructions(), 39U);
  EXPECT_EQ(processor.cycles(), 39U * 3 / 2);
}

/// programs/timing.s: the sequences and their durations by table 3-1 and 3.3.2 of the technical reference manual.
TEST(ExecutionTime, IsThatOfTheTechnicalReferenceManual) {
  NotingSystem system;
  CortexM3 processor(system, MemoryMap{}, Timing{});
  system.processor = &processor;
  const auto image = read_program("timing");
  processor.load(0x08000000, image.data(), image.size());
  processor.run();
  EXPECT_THAT(system.notes, ElementsAreArray({
                                1, 1, 2,                     // data processing
                                3, 5, 4, 7,                  // long products
                                2, 2, 3, 5, 12, 5, 6,        // divisions
                                2, 3, 4, 6,                  // loads
                                1, 2, 3, 3, 4,               // stores, an address just computed
                                5, 5, 3, 3,                  // several words
                                3, 4, 3, 2,                  // not aligned
                                2, 4, 3, 4,                  // branches
                                4, 5, 5, 9, 6,  6, 8, 4, 3,  // by registers and loads, LDREX and STREX
                                2, 3, 1, 2, 1,  4            // IT, special registers, barriers
                            }));
}

/// For each pair of programs/flash.s: the extra time of the second.
std::vector<std::uint32_t> in_flash(unsigned wait_states, bool prefetches, std::uint32_t millicycles = 0) {
  NotingSystem system;
  Timing timing;
  timing.millicycles_per_instruction = millicycles;
  CortexM3 processor(system, MemoryMap{}, timing);
  system.processor = &processor;
  processor.set_flash(wait_states, prefetches);
  const auto image = read_program("flash");
  processor.load(0x08000000, image.data(), image.size());
  processor.run();
  std::vector<std::uint32_t> more;
  for (std::size_t n = 0; n + 1 < system.notes.size(); n += 2) more.push_back(system.notes[n + 1] - system.notes[n]);
  return more;
}

TEST(ExecutionTime, IsThatOfFlashWhereItIsLonger) {
  // 32 NOPs, 32 instructions of two halfwords; ten loops of 2, 14, 6 and 3 instructions, 8 literals with a NOP each;
  // ten loops of 6 instructions over the end of a line, which may be that of 64 KB.
  EXPECT_THAT(in_flash(0, true), ElementsAre(32U, 32U, 30U, 150U, 70U, 50U, 24U, 80U, 80U));
  // A line of 8 bytes every 3 cycles: NOPs need it every 4, the others every 2. A loop that leaves two lines waits for
  // the first one, and for both if its first instruction spans two; six lines and eight literals keep flash busy for 14
  // times 3 cycles.
  EXPECT_THAT(in_flash(2, true), ElementsAre(32U, 48U, 30U, 170U, 90U, 100U, 42U, 100U, 100U));
  EXPECT_THAT(in_flash(1, true), ElementsAre(32U, 32U, 30U, 160U, 80U, 80U, 32U, 90U, 90U));
  // Without prefetch words of 4 bytes, each with 2 cycles of waiting.
  EXPECT_THAT(in_flash(2, false), ElementsAre(64U, 96U, 30U, 290U, 130U, 110U, 64U, 140U, 140U));
  EXPECT_THAT(in_flash(2, true, 1000), ElementsAre(32U, 32U, 20U, 140U, 60U, 30U, 16U, 60U, 60U)) << "all the same";
}

TEST_F(Execution, AccessesArriveInOrderWithSizeAndTheCycleAtWhichTheyBegin) {
  system.access_cycles = 10;
  for (std::uint8_t byte = 0; byte < 16; ++byte)
    system.memory[0x60000000U + byte] = static_cast<std::uint8_t>(0x80 + byte);
  run("accesses");
  std::vector<std::uint64_t> cycles;
  for (std::size_t n = 0; n < 5; ++n) cycles.push_back(system.accesses[n].cycle);
  EXPECT_THAT(cycles, ElementsAre(1U, 12U, 23U, 34U, 45U));  // ten own cycles and one of the instruction each
  std::vector<std::tuple<bool, std::uint32_t, unsigned>> seen;
  for (const Access& access : system.accesses) seen.emplace_back(access.write, access.address, access.bytes);
  using A = std::tuple<bool, std::uint32_t, unsigned>;
  EXPECT_THAT(seen, ElementsAre(A{false, 0x60000001, 1}, A{false, 0x60000002, 2}, A{false, 0x60000004, 4},
                                A{false, 0x60000008, 1}, A{false, 0x6000000A, 2}, A{false, 0x60000000, 4},
                                A{false, 0x60000004, 4}, A{false, 0x60000000, 4}, A{false, 0x60000004, 4},
                                A{true, 0x60000011, 1}, A{true, 0x60000012, 2}, A{true, 0x60000014, 4},
                                A{true, 0x60000000, 4}, A{true, 0x60000004, 4}, A{false, 0xA0000008, 4}));
  EXPECT_EQ(r(1), 0x81U);
  EXPECT_EQ(r(2), 0x8382U);
  EXPECT_EQ(r(3), 0x87868584U);
  EXPECT_EQ(r(4), 0xFFFFFF88U);
  EXPECT_EQ(r(5), 0xFFFF8B8AU);
  EXPECT_EQ(r(9), 0x87868584U);
  EXPECT_EQ(system.memory[0x60000011], 0xD4);
  EXPECT_EQ(system.memory[0x60000013], 0xC3);
}

TEST_F(Execution, TheWorldIsCalledWhenItSays) {
  system.interrupts = {{200, 0}};
  const std::uint32_t once = 1;
  std::copy_n(reinterpret_cast<const std::uint8_t*>(&once), 4, processor.ram() + 0x100);
  run("waiting");
  // 12 cycles of entry, then the handler's third instruction notes it.
  EXPECT_EQ(system.note_cycles[1], 200 + 12 + 2U);
  EXPECT_EQ(std::count_if(system.kept_up_at.begin(), system.kept_up_at.end(),
                          [](std::uint64_t cycle) { return cycle > 40 && cycle < 200; }),
            0)
      << "nothing was due";
}

TEST_F(Execution, TheWorldIsCalledBehindAStoreThatIsWatched) {
  run("interrupted");
  const std::size_t before = std::exchange(system.kept_up_at, {}).size();
  processor.watch(0x20000200, 4);
  processor.run();
  EXPECT_GT(system.kept_up_at.size(), before);
}

TEST_F(Execution, BitBandReadsAndWritesSingleBits) {
  system.memory[0x4001000D] = 0x80;
  run("bits");
  EXPECT_EQ(r(2), 1U);
  EXPECT_EQ(r(3), 1U << 9 | 1U << 11);
  EXPECT_EQ(r(4), 0U) << "only bit 0 of what is written counts";
  EXPECT_EQ(r(5), 1U);
  EXPECT_EQ(r(6), 0U);
  ASSERT_GE(system.accesses.size(), 2U);
  EXPECT_FALSE(system.accesses[0].write);
  EXPECT_EQ(system.accesses[0].address, 0x4001000CU);
  EXPECT_EQ(system.accesses[0].bytes, 4U);
  EXPECT_TRUE(system.accesses[1].write);
  EXPECT_EQ(system.accesses[1].value, 0x0000A000U);
}

TEST_F(Execution, CycleCounterCountsCycles) {
  run("cycle_counter");
  EXPECT_EQ(r(3), 0U);
  EXPECT_EQ(r(5) - r(4), 3U);
  EXPECT_EQ(r(6), 101U);
  EXPECT_EQ(r(7), 0x40000001U);
}

TEST_F(Execution, SystemResetStartsAgainAtTheVectorTable) {
  run("restart");
  EXPECT_THAT(system.notes, ElementsAre(1U, 0U, 2U, 0U));
  EXPECT_EQ(system.resets, 1U);
}

TEST_F(Execution, SystemControlBlockTellsWhatTheProcessorIs) {
  system.memory[0xE0042001] = 0x04;
  run("identity");
  EXPECT_EQ(r(2), 0x411FC231U);
  EXPECT_EQ(r(3), 2U);
  EXPECT_EQ(r(4), 0xF0000000U) << "four bits of a priority are implemented";
  EXPECT_EQ(r(5), 0xF0U);
  EXPECT_EQ(r(6), 0xF000U);
  EXPECT_EQ(r(7), 0x400U) << "what the core does not have on its private bus is the System's";
  EXPECT_EQ(processor.registers().r[8], 0x800U) << "nothing active, nothing pending once the handler has run";
  EXPECT_EQ(processor.registers().r[9], 0x811U);
  EXPECT_EQ(processor.registers().r[10], 2U);
}

TEST_F(Execution, AnExceptionOfTheSystemLeavesThroughRun) {
  struct Torn {};
  system.on_access = [](const Access&) { throw Torn{}; };
  EXPECT_THROW(run("accesses"), Torn);
  EXPECT_EQ(system.accesses.size(), 1U) << "nothing comes after it";
  system.on_access = nullptr;
  system.accesses.clear();
  processor.run();
  EXPECT_EQ(system.accesses.size(), 15U) << "the processor can be run again";
}

TEST_F(Execution, AnExceptionOfKeepUpAndSleepLeavesThroughRun) {
  system.on_keep_up = [] { throw std::length_error("enough"); };
  EXPECT_THROW(run("arithmetic"), std::length_error);
  system.on_keep_up = nullptr;
  system.on_sleep = [](std::uint64_t) { throw std::length_error("enough"); };
  EXPECT_THROW(run("sleep"), std::length_error);
}

TEST_F(Execution, AFiberIsSuspendedInsideOfALoad) {
  user_cpu::Fiber* inside = nullptr;
  user_cpu::Fiber fiber([this] { run("accesses"); });
  inside = &fiber;
  system.on_access = [&inside](const Access&) { inside->suspend(); };
  unsigned suspended = 0;
  for (fiber.resume(); !fiber.ended(); fiber.resume()) ++suspended;
  EXPECT_EQ(suspended, 15U);
  EXPECT_EQ(system.accesses.size(), 15U);
}

TEST_F(Execution, AFiberSuspendedInsideOfALoadCanBeDestroyed) {
  auto fiber = std::make_unique<user_cpu::Fiber>([this] { run("accesses"); });
  system.on_access = [&fiber](const Access&) { fiber->suspend(); };
  fiber->resume();
  fiber->resume();
  fiber.reset();
  EXPECT_EQ(system.accesses.size(), 2U);
}

TEST(TwoProcessors, TakeTurnsOnFibersOfTheirOwn) {
  struct Board {
    Board() : processor(system, MemoryMap{}, Timing{}) {
      system.processor = &processor;
      const auto image = read_program("nesting");
      processor.load(0x08000000, image.data(), image.size());
      system.on_access = [this](const Access&) { fiber.suspend(); };
    }
    NotingSystem system;
    CortexM3 processor;
    user_cpu::Fiber fiber{[this] { processor.run(); }};
  };
  Board one, other;
  while (!one.fiber.ended()) {
    one.fiber.resume();
    other.fiber.resume();
  }
  EXPECT_TRUE(other.fiber.ended());
  EXPECT_EQ(one.system.notes.size(), 7U);
  EXPECT_EQ(one.system.notes, other.system.notes);
  EXPECT_EQ(one.system.note_cycles, other.system.note_cycles);
}

TEST_F(Execution, CodeLoadedDuringTheRunIsWhatIsExecuted) {
  constexpr std::uint8_t kRoutine[] = {0x01, 0x20, 0x70, 0x47};  // movs r0, #1; bx lr
  constexpr std::uint32_t kInFlash = 0x08000170, kInRam = 0x20000200;
  processor.load(kInRam, kRoutine, sizeof kRoutine);
  system.on_access = [this](const Access&) {
    const auto number = static_cast<std::uint8_t>(system.notes.size());
    const std::uint8_t routine[] = {number, 0x20, 0x70, 0x47};
    processor.load(kInFlash, routine, sizeof routine);
    processor.load(kInRam, routine, sizeof routine);
    if (system.notes.size() == 8) processor.stop();
  };
  run("patched");
  EXPECT_THAT(system.notes, ElementsAre(1U, 1U, 2U, 3U, 4U, 5U, 6U, 7U));
}

TEST_F(Execution, LoadRefusesWhatIsNeitherFlashNorRam) {
  const std::vector<std::uint8_t> bytes(16);
  EXPECT_THROW(processor.load(0x0807FFF8, bytes.data(), bytes.size()), std::out_of_range);
  EXPECT_THROW(processor.load(0x20010000, bytes.data(), bytes.size()), std::out_of_range);
  EXPECT_THROW(processor.load(0xFFFFFFF8, bytes.data(), bytes.size()), std::out_of_range);
  EXPECT_THROW(processor.set_interrupt(68), std::out_of_range);
}

}  // namespace
}  // namespace dsdpv1::arm

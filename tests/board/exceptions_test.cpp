// Interrupts, system exceptions, SysTick and sleep on the processor.
#include <gmock/gmock.h>

#include <cstring>
#include <optional>

#include "tests/board/processor_bench.hpp"

namespace dsdpv1::arm {
namespace {

using testing::ElementsAre;

class Exceptions : public ProcessorBench {
 protected:
  void TearDown() override { EXPECT_TRUE(faults.empty()); }
};

TEST_F(Exceptions, InterruptsNestByPriority) {
  run("nesting");
  EXPECT_THAT(system.notes, ElementsAre(1U, 10U, 20U, 0xFFFFFFF1U, 11U, 16U, 2U));
}

TEST_F(Exceptions, EntryAndReturnTakeTwelveCycles) {
  run("nesting");
  // str to ISPR, entry, push and two loads, str
  EXPECT_EQ(system.note_cycles[1] - system.note_cycles[0], 1 + 3 + 12 + 3U);
  // str, three instructions of control, entry, two loads
  EXPECT_EQ(system.note_cycles[2] - system.note_cycles[1], 4 + 12 + 2U);
  // bx, return, two loads
  EXPECT_EQ(system.note_cycles[4] - system.note_cycles[3], 1 + 1 + 12 + 2U);
}

TEST_F(Exceptions, PendingOnesGoByPriorityThenNumberAndMasksHoldThemBack) {
  run("priorities");
  EXPECT_THAT(system.notes, ElementsAre(1U, 12U, 77U, 10U, 11U, 2U,  // all after cpsie
                                        12U, 3U, 10U, 4U,            // BASEPRI 0x40 keeps out 0x40
                                        5U, 12U, 6U));               // FAULTMASK
}

TEST_F(Exceptions, TailChainingTakesSixCycles) {
  run("priorities");
  EXPECT_EQ(system.note_cycles[2] - system.note_cycles[1], 1 + 1 + 6 + 2U);
}

TEST_F(Exceptions, PriorityGroupingDecidesWhatPreempts) {
  run("grouping");
  EXPECT_THAT(system.notes, ElementsAre(0xFA050000U, 0xFA050700U, 10U, 11U, 30U, 20U));
}

TEST_F(Exceptions, ALevelSensitiveSourceComesAgainWhileItIsHigh) {
  const std::uint32_t times = 3;
  std::copy_n(reinterpret_cast<const std::uint8_t*>(&times), 4, processor.ram() + 0x100);
  system.on_access = [this](const Access& access) {
    if (access.value == 1 && system.notes.size() == 1)
      processor.set_interrupt_level(0, true);
    else if (system.notes.back() == 3)
      processor.set_interrupt_level(0, false);
  };
  run("waiting");
  EXPECT_THAT(system.notes, ElementsAre(1U, 1U, 2U, 3U, 2U));
}

TEST_F(Exceptions, AHigherOneThatArrivesDuringEntryGoesFirst) {
  const std::uint32_t times = 1;
  std::copy_n(reinterpret_cast<const std::uint8_t*>(&times), 4, processor.ram() + 0x100);
  // Both have priority 0: of those pending when the entry ends, the lower number goes first.
  system.interrupts = {{100, 1}, {111, 0}};
  run("waiting");
  EXPECT_THAT(system.notes, ElementsAre(1U, 1U, 11U, 2U)) << "entry of interrupt 1 from 100 to 112";
}

TEST_F(Exceptions, AnItBlockIsLeftAndGoesOnAfterTheReturn) {
  system.interrupts = {{10'000, 0}};
  run("it_blocks");
  EXPECT_THAT(system.notes, ElementsAre(10U, 2U, 3U, 20U, 10U));
  EXPECT_EQ(r(4), 7U);
  EXPECT_EQ(r(5), 0U);
  EXPECT_EQ(r(6), 9U);
  EXPECT_EQ(r(7), 1U);
}

/// The result of a program interrupted in this cycle, if any.
std::vector<std::uint32_t> interrupted_at(std::optional<std::uint64_t> cycle, bool& came) {
  Timing timing;
  timing.millicycles_per_instruction = 1000;
  NotingSystem system;
  CortexM3 processor(system, MemoryMap{}, timing);
  system.processor = &processor;
  if (cycle) system.interrupts = {{*cycle, 0}};
  const std::vector<std::uint8_t> image = read_program("interrupted");
  processor.load(MemoryMap{}.flash_base, image.data(), image.size());
  processor.run();
  came = !system.notes.empty();
  const Registers all = processor.registers();
  std::vector<std::uint32_t> left(all.r.begin() + 4, all.r.begin() + 12);
  left.push_back(all.sp);
  for (std::uint32_t offset = 0x1C0; offset < 0x240; offset += 4) {
    std::uint32_t word = 0;
    std::memcpy(&word, processor.ram() + offset, sizeof word);
    left.push_back(word);
  }
  return left;
}

TEST(Interrupted, ProgramsLeaveTheSameInWhicheverCycleItIs) {
  bool came = false;
  const std::vector<std::uint32_t> undisturbed = interrupted_at(std::nullopt, came);
  EXPECT_FALSE(came);
  unsigned times = 0;
  for (std::uint64_t cycle = 4; cycle < 120; ++cycle) {
    EXPECT_EQ(interrupted_at(cycle, came), undisturbed) << cycle;
    times += came ? 1 : 0;
  }
  EXPECT_GT(times, 60U) << "cycles of the program";
}

/// Cycles of the notes of a program whose interrupt 0 comes at `cycle`, if any.
std::vector<std::uint64_t> notes_of(const std::string& program, std::optional<std::uint64_t> cycle,
                                    unsigned wait_states = 0) {
  NotingSystem system;
  CortexM3 processor(system, MemoryMap{}, Timing{});
  system.processor = &processor;
  processor.set_flash(wait_states, true);
  if (cycle) system.interrupts = {{*cycle, 0}};
  const std::vector<std::uint8_t> image = read_program(program);
  processor.load(MemoryMap{}.flash_base, image.data(), image.size());
  processor.run();
  return system.note_cycles;
}

/// Cycles beyond 12 from an interrupt to its handler, for each cycle between the two notes of programs/latency.s.
std::vector<std::uint64_t> latencies_beyond_12(unsigned wait_states) {
  const std::vector<std::uint64_t> alone = notes_of("latency", std::nullopt, wait_states);
  std::vector<std::uint64_t> beyond;
  for (std::uint64_t cycle = alone.at(0) + 1; cycle < alone.at(1); ++cycle)
    beyond.push_back(notes_of("latency", cycle, wait_states).at(1) - cycle - 12);
  return beyond;
}

TEST(Interrupted, TheHandlerBeginsWithinTwoCyclesOfTwelveWhateverIsAtWork) {
  // What has begun to read data from flash ends first: LATENCY more.
  for (unsigned wait_states = 0; wait_states < 3; ++wait_states)
    EXPECT_THAT(latencies_beyond_12(wait_states), testing::Each(testing::Le(2U + wait_states)));
}

/// What an interrupt in each cycle of an instruction costs beside the 26 cycles of entry, STR, BX LR and return.
struct BrokenOff {
  unsigned cycles;
  std::function<int(unsigned)> more;  ///< by the cycles that the instruction has had
  unsigned later = 0;                 ///< most cycles that the handler begins later than 12
};

TEST(Interrupted, LongInstructionsAreBrokenOffAndBeginAgainOrGoOn) {
  const auto nothing = [](unsigned) { return 0; };
  const auto goes_on = [](unsigned had) { return had == 0 ? 0 : 1; };
  const auto restarts = [](unsigned had) { return static_cast<int>(had); };
  const auto pops = [](unsigned had) { return had == 0 ? 0 : had < 5 ? 1 : static_cast<int>(had) - 8; };
  const std::vector<BrokenOff> all = {{10, goes_on},   // LDM of nine
                                      {10, goes_on},   // STM
                                      {12, restarts},  // UDIV
                                      {5, restarts},   // UMULL
                                      {1, nothing},    // CMP
                                      {1, nothing},    // NOP
                                      {1, nothing},    // IT
                                      {4, restarts},   // LDM in an IT block
                                      {1, nothing},    // ADD in it
                                      {8, pops}};      // POP of four with PC: 5, and 3 for the pipeline
  const std::vector<std::uint64_t> alone = notes_of("broken_off", std::nullopt);
  ASSERT_EQ(alone.size(), 2U);
  std::uint64_t cycle = alone[0] + 1;
  for (const BrokenOff& each : all) {
    for (unsigned had = 0; had < each.cycles; ++had, ++cycle) {
      const std::vector<std::uint64_t> notes = notes_of("broken_off", cycle);
      ASSERT_EQ(notes.size(), 3U);
      EXPECT_EQ(notes[1], cycle + 12) << &each - all.data() << ", " << had;
      EXPECT_EQ(static_cast<int>(notes[2] - alone[1]) - (12 + 1 + 1 + 12), each.more(had))
          << &each - all.data() << ", " << had;
    }
  }
  EXPECT_EQ(cycle, alone[1]);
}

TEST(Interrupted, AnInterruptDuringAReturnIsChainedAndOneDuringAnEntryHasItsOwnVectorFetched) {
  const std::vector<std::uint64_t> alone = notes_of("broken_off", std::nullopt);
  const auto notes_of_two = [&](std::uint64_t first, unsigned second_irq, std::uint64_t second) {
    NotingSystem system;
    CortexM3 processor(system, MemoryMap{}, Timing{});
    system.processor = &processor;
    system.interrupts = {{first, 1}, {second, second_irq}};
    const std::vector<std::uint8_t> image = read_program("latency_of_two");
    processor.load(MemoryMap{}.flash_base, image.data(), image.size());
    processor.run();
    return std::make_pair(system.notes, system.note_cycles);
  };
  for (std::uint64_t after = 1; after < 12; ++after) {
    const auto [notes, cycles] = notes_of_two(100, 0, 100 + after);
    EXPECT_EQ(notes[1], 10U) << "the better one first";
    EXPECT_EQ(cycles[1], std::max<std::uint64_t>(112, 100 + after + 6)) << after;
  }
  // The handler of interrupt 1 begins at 112, its return at 114.
  for (std::uint64_t after = 1; after < 12; ++after) {
    const auto [notes, cycles] = notes_of_two(100, 0, 114 + after);
    EXPECT_EQ(notes[2], 10U);
    EXPECT_EQ(cycles[2], 114 + after + 6) << after;
  }
}

/// Cycles of a program's notes in flash that waits; the world wants to be asked before every instruction, or only when
/// something happens. The first note makes interrupt 0 come, too, which is told when the world is asked.
std::vector<std::uint64_t> notes_asking(const std::string& program, bool always) {
  NotingSystem system;
  CortexM3 processor(system, MemoryMap{}, Timing{});
  system.processor = &processor;
  processor.set_flash(2, false);
  system.next_keep_up = always ? 0 : kNever;
  system.interrupts = {{300, 0}};
  system.on_access = [&](const Access&) {
    if (system.notes.size() == 1) system.interrupts.emplace(processor.cycles(), 0);
  };
  const std::vector<std::uint8_t> image = read_program(program);
  processor.load(MemoryMap{}.flash_base, image.data(), image.size());
  processor.run();
  return system.note_cycles;
}

TEST(Interrupted, TheHandlerBeginsAtTheSameCycleHoweverOftenTheWorldIsAsked) {
  for (const char* program : {"latency", "nesting", "priorities", "grouping", "it_blocks", "tasks", "tick"})
    EXPECT_EQ(notes_asking(program, true), notes_asking(program, false)) << program;
}

TEST_F(Exceptions, SysTickComesToTheCycle) {
  run("tick");
  ASSERT_GE(system.note_cycles.size(), 3U);
  EXPECT_EQ(system.note_cycles[1] - system.note_cycles[0], 100U);
  EXPECT_EQ(system.note_cycles[2] - system.note_cycles[1], 100U);
  EXPECT_EQ(r(4), 0x00010005U) << "COUNTFLAG";
  EXPECT_EQ(r(5) - r(6), 1U);
  EXPECT_EQ(r(8), 99U);
}

TEST_F(Exceptions, SleepEndsWithWhatMayWakeIt) {
  system.interrupts = {{1000, 0}, {3000, 0}, {4000, 0}, {9000, 0}, {10'000, 1}};
  run("sleep");
  EXPECT_THAT(system.notes, ElementsAre(1U, 2U, 10U, 3U,   // PRIMASK keeps the handler out, not the waking
                                        4U, 10U, 5U,       // SEV lets one WFE pass, not two
                                        10U, 6U, 12U, 7U,  // WFI until an interrupt, until SysTick
                                        10U, 11U, 8U));    // SLEEPONEXIT until the second handler clears it
  EXPECT_GE(system.note_cycles[1], 1000U);
  EXPECT_LT(system.note_cycles[1], 1010U);
}

TEST_F(Exceptions, ThreadsWithStacksOfTheirOwnTakeTurns) {
  run("tasks");
  EXPECT_THAT(system.notes,
              ElementsAre(1U, 14U, 0xFFFFFFFDU, 11U, 3U,  // CONTROL: unprivileged, process stack, not to be changed
                          14U, 0xFFFFFFFDU, 2U, 14U, 0xFFFFFFFDU, 12U, 14U, 0xFFFFFFFDU, 3U));
}

TEST_F(Exceptions, FaultInsideOfAnItBlockKeepsWhatIsLeftOfIt) {
  system.on_access = [this](const Access& access) {
    if (access.address == 0x90000000) processor.bus_error();
  };
  run("it_fault");
  ASSERT_EQ(system.notes.size(), 1U);
  constexpr std::uint32_t kNeEq = 0x14;  // ITSTATE of NE, then EQ: 0001 0100
  EXPECT_EQ(system.notes[0], (kNeEq >> 2U) << 10);
  EXPECT_EQ(r(4), 42U);
  EXPECT_EQ(r(5), 0U);
  faults.clear();
}

class Faults : public ProcessorBench {
 protected:
  enum Case : std::uint32_t {
    kUndefined,
    kBadLoad,
    kBadStore,
    kFlashStore,
    kEvenBranch,
    kFarBranch,
    kDeviceBranch,
    kBreakpoint,
    kMaskedSvc,
    kBadReturn,
    kNoStack,
    kCoprocessor,
    kWrongPsp,
    kRefused,
  };
  void choose(Case which, std::uint32_t shcsr = 0, std::uint32_t fault_again = 0) {
    const std::uint32_t words[] = {which, shcsr, fault_again};
    std::memcpy(processor.ram() + 0x100, words, sizeof words);
    system.on_access = [this](const Access& access) {
      if (access.address == 0x40005000) processor.bus_error();
    };
  }
  Fault unhandled(Case which) {
    choose(which);
    try {
      run("faults_unhandled");
    } catch (const FaultError& error) {
      EXPECT_EQ(faults.size(), 1U);
      EXPECT_EQ(faults.at(0).text, error.what());
      EXPECT_EQ(error.fault().outcome, FaultOutcome::kNoHandler);
      EXPECT_EQ(error.fault().registers.pc, error.fault().pc);
      return error.fault();
    }
    ADD_FAILURE() << "no fault";
    return {};
  }
  static constexpr std::uint32_t kAll = 0x70000, kForced = 1U << 30;
};

TEST_F(Faults, WithoutHandlerEndTheRunWithKindAndPlace) {
  EXPECT_EQ(unhandled(kUndefined).kind, FaultKind::kUndefinedInstruction);
}

TEST_F(Faults, LoadWhereNothingAnswers) {
  const Fault fault = unhandled(kBadLoad);
  EXPECT_EQ(fault.kind, FaultKind::kData);
  EXPECT_EQ(fault.address, 0x20010004U);
  EXPECT_EQ(fault.registers.r[2], 0x20010000U);
  EXPECT_EQ(fault.registers.r[0], 0x11111111U);
  EXPECT_THAT(fault.text, testing::HasSubstr("0x20010004"));
  EXPECT_THAT(table(fault.registers), testing::HasSubstr("11111111"));
}

TEST_F(Faults, StoreWhereNothingAnswers) {
  const Fault fault = unhandled(kBadStore);
  EXPECT_EQ(fault.kind, FaultKind::kData);
  EXPECT_EQ(fault.address, 0x30000000U);
}

TEST_F(Faults, StoreToFlash) {
  const Fault fault = unhandled(kFlashStore);
  EXPECT_EQ(fault.kind, FaultKind::kData);
  EXPECT_EQ(fault.address, 0x08000010U);
}

TEST_F(Faults, BranchToAnEvenAddress) { EXPECT_EQ(unhandled(kEvenBranch).kind, FaultKind::kInvalidState); }

TEST_F(Faults, BranchOutOfFlash) {
  const Fault fault = unhandled(kFarBranch);
  EXPECT_EQ(fault.kind, FaultKind::kFetch);
  EXPECT_EQ(fault.pc, 0x08100000U);
}

TEST_F(Faults, BranchIntoAPeripheral) {
  const Fault fault = unhandled(kDeviceBranch);
  EXPECT_EQ(fault.kind, FaultKind::kFetch);
  EXPECT_EQ(fault.pc, 0x40000100U);
  EXPECT_TRUE(system.accesses.empty());
}

TEST_F(Faults, BreakpointInstruction) { EXPECT_EQ(unhandled(kBreakpoint).kind, FaultKind::kBreakpoint); }

TEST_F(Faults, StackOutsideOfRam) {
  const Fault fault = unhandled(kNoStack);
  EXPECT_EQ(fault.kind, FaultKind::kStacking);
  EXPECT_EQ(fault.address, 0x1FFFFFF0U);
}

TEST_F(Faults, AccessThatTheSystemRefuses) {
  const Fault fault = unhandled(kRefused);
  EXPECT_EQ(fault.kind, FaultKind::kData);
  EXPECT_EQ(fault.address, 0x40005000U);
  EXPECT_EQ(fault.registers.r[2], 0x40005000U);
}

TEST_F(Faults, ReturnToAnExceptionThatTheProcessorDoesNotHave) {
  EXPECT_THROW(run("wrong_exception"), FaultError);
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.back().kind, FaultKind::kExceptionReturn);
  EXPECT_EQ(faults.back().address & 0x1FFU, 300U);
}

struct Handled {
  std::uint32_t which, shcsr, handler, cfsr, hfsr;
};
class HandledFaults : public Faults, public testing::WithParamInterface<Handled> {};

TEST_P(HandledFaults, ReachTheFirmwaresHandlerWithTheirStatusBits) {
  const Handled& expected = GetParam();
  choose(static_cast<Case>(expected.which), expected.shcsr);
  run("faults_handled");
  EXPECT_THAT(system.notes, ElementsAre(expected.handler, expected.cfsr, expected.hfsr));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].outcome, FaultOutcome::kHandled);
  EXPECT_EQ(faults[0].handler, expected.handler);
}

// Case, SHCSR, exception, CFSR, HFSR
constexpr Handled kHandledFaults[] = {
    {0, 0, 3, 0x00010000, 0x40000000}, {0, 0x70000, 6, 0x00010000, 0},     {1, 0, 3, 0x00008200, 0x40000000},
    {1, 0x70000, 5, 0x00008200, 0},    {3, 0x70000, 5, 0x00008200, 0},     {4, 0x70000, 6, 0x00020000, 0},
    {5, 0x70000, 5, 0x00000100, 0},    {6, 0x70000, 4, 0x00000001, 0},     {7, 0x70000, 3, 0, 0x80000000},
    {8, 0x70000, 3, 0, 0x40000000},    {9, 0x70000, 6, 0x00040000, 0},     {11, 0x70000, 6, 0x00080000, 0},
    {12, 0x70000, 5, 0x00000800, 0},   {13, 0x70000, 5, 0x00008200, 0},    {14, 0x70000, 6, 0x01000000, 0},
    {15, 0x70000, 6, 0x01000000, 0},   {16, 0, 3, 0x01000000, 0x40000000},
};
INSTANTIATE_TEST_SUITE_P(All, HandledFaults, testing::ValuesIn(kHandledFaults));

TEST_F(Faults, InsideOfHardFaultLockUp) {
  choose(kBadLoad, 0, 1);
  EXPECT_THROW(run("faults_handled"), FaultError);
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].outcome, FaultOutcome::kHandled);
  EXPECT_EQ(faults[1].outcome, FaultOutcome::kLockup);
  EXPECT_EQ(faults[1].kind, FaultKind::kUndefinedInstruction);
}

TEST_F(Faults, InsideOfAUsageFaultHandlerEscalate) {
  choose(kUndefined, kAll, 1);
  EXPECT_THROW(run("faults_handled"), FaultError);
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_EQ(faults[1].handler, 3U);
  EXPECT_EQ(faults[2].outcome, FaultOutcome::kLockup);
}

TEST_F(Faults, AHandlerMayStepOverTheInstruction) {
  run("recovery");
  EXPECT_EQ(r(6), 6U);
  EXPECT_EQ(r(4), r(5));
  EXPECT_EQ(r(7), r(4) - 36) << "a frame begins at a multiple of eight";
}

TEST_F(Faults, WithoutProgramTheRunEndsAtOnce) {
  EXPECT_THROW(processor.run(), FaultError);
  EXPECT_EQ(processor.instructions(), 0U);
}

}  // namespace
}  // namespace dsdpv1::arm

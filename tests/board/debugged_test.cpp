// The processor under a scripted debugger.
#include <gmock/gmock.h>

#include <functional>

#include "tests/board/processor_bench.hpp"

namespace dsdpv1::arm {
namespace {

using testing::ElementsAre;

class ListedDebugger : public Debugger {
 public:
  bool wanted() const override { return static_cast<bool>(before); }
  void before_instruction(std::uint32_t pc) override { before(pc); }
  void data_access(std::uint32_t address, std::uint32_t size, bool write) override {
    accesses.push_back({write, address, size, 0, 0});
  }
  void poll() override { ++polls; }
  void fault(const std::string& what) override { fault_texts.push_back(what); }

  std::function<void(std::uint32_t)> before;
  std::vector<Access> accesses;
  std::vector<std::string> fault_texts;
  unsigned polls = 0;
};

class Debugged : public ProcessorBench {
 protected:
  Debugged() { processor.attach(&debugger); }
  DebugTarget& target() { return processor; }
  ListedDebugger debugger;
};

TEST_F(Debugged, EachInstructionIsAnnouncedOnce) {
  std::vector<std::uint32_t> addresses;
  debugger.before = [&addresses](std::uint32_t pc) { addresses.push_back(pc); };
  run("nesting");
  // Entry and return stop the engine before an instruction that is repeated: it is not counted, and not executed twice.
  EXPECT_GE(addresses.size(), processor.instructions());
  EXPECT_THAT(system.notes, ElementsAre(1U, 10U, 20U, 0xFFFFFFF1U, 11U, 16U, 2U));
}

TEST_F(Debugged, RegistersCanBeChangedBetweenTwoInstructions) {
  unsigned steps = 0;
  debugger.before = [&](std::uint32_t pc) {
    if (++steps == 3) {  // first adds of the loop
      EXPECT_EQ(target().read_register(Register::kPc), pc);
      EXPECT_EQ(target().read_register(Register::kR0), 10U);
      target().write_register(Register::kR0, 3);
    }
  };
  run("arithmetic");
  EXPECT_EQ(r(1), 6U);
}

TEST_F(Debugged, HandlerThatWasGivenTheNumberOfNoExceptionCannotReturn) {
  bool written = false;
  debugger.before = [&](std::uint32_t) {
    const std::uint32_t xpsr = target().read_register(Register::kXpsr);
    if (written || (xpsr & 0x1FFU) == 0) return;
    target().write_register(Register::kXpsr, (xpsr & ~0x1FFU) | 300U);
    written = true;
  };
  EXPECT_THROW(run("nesting"), FaultError);
  EXPECT_TRUE(written);
  EXPECT_EQ(faults.back().kind, FaultKind::kExceptionReturn);
}

TEST_F(Debugged, ExecutionGoesOnWhereTheProgramCounterWasSet) {
  unsigned steps = 0;
  debugger.before = [&](std::uint32_t pc) {
    if (++steps == 3) target().write_register(Register::kPc, pc + 6);  // past the loop, at cmp
  };
  run("arithmetic");
  EXPECT_EQ(r(1), 0U);
  EXPECT_EQ(r(2), 1U) << "cmp has found 0, not 55";
}

TEST_F(Debugged, ItStateIsShownInXpsr) {
  std::vector<std::uint32_t> states;
  debugger.before = [&](std::uint32_t) {
    const std::uint32_t xpsr = target().read_register(Register::kXpsr);
    states.push_back((xpsr >> 25 & 3U) | (xpsr >> 8 & 0xFCU));
  };
  run("arithmetic");
  ASSERT_EQ(states.size(), 39U);  // also the one whose condition fails
  EXPECT_THAT(std::vector<std::uint32_t>(states.end() - 6, states.end()), ElementsAre(0U, 0x12U, 0x04U, 0x08U, 0U, 0U));
}

TEST_F(Debugged, AccessesAreReportedOnceAskedFor) {
  debugger.before = [&](std::uint32_t) {
    if (system.accesses.size() == 2)
      target().report_data_accesses(true);
    else if (system.accesses.size() == 4)
      target().report_data_accesses(false);
  };
  run("accesses");
  ASSERT_EQ(debugger.accesses.size(), 2U);
  EXPECT_EQ(debugger.accesses[0].address, 0x60000004U);
  EXPECT_EQ(debugger.accesses[0].bytes, 4U);
  EXPECT_FALSE(debugger.accesses[0].write);
  EXPECT_EQ(debugger.accesses[1].address, 0x60000008U);
}

TEST_F(Debugged, MemoryIsReadAndRamWritten) {
  const std::uint8_t bytes[] = {1, 2, 3, 4};
  EXPECT_TRUE(target().write_memory(0x2000FFFC, bytes, 4));
  EXPECT_FALSE(target().write_memory(0x2000FFFD, bytes, 4));
  EXPECT_FALSE(target().write_memory(0x08000000, bytes, 4));
  std::uint8_t back[8] = {};
  EXPECT_EQ(target().read_memory(0x2000FFFD, back, 8), 3U);
  EXPECT_THAT(back, ElementsAre(2, 3, 4, 0, 0, 0, 0, 0));
  EXPECT_EQ(target().read_memory(0x40000000, back, 8), 0U);
}

TEST_F(Debugged, AnInstructionIsNotAnnouncedAgainBecauseMemoryWasWritten) {
  const std::uint8_t byte = 0;
  std::vector<std::uint32_t> addresses;
  debugger.before = [&](std::uint32_t pc) {
    addresses.push_back(pc);
    target().write_memory(0x20000000, &byte, 1);
  };
  run("arithmetic");
  EXPECT_EQ(addresses.size(), 39U);
  EXPECT_EQ(processor.instructions(), 39U);
}

TEST_F(Debugged, AResetStartsAgainAndAnEndEnds) {
  unsigned steps = 0;
  debugger.before = [&](std::uint32_t) {
    if (++steps == 10)
      target().reset();
    else if (steps == 30)
      target().end_run();
  };
  run("arithmetic");
  EXPECT_EQ(system.resets, 1U);
  EXPECT_EQ(processor.instructions(), 9 + 19U) << "neither the tenth nor the last announced is executed";
}

TEST_F(Debugged, IsToldOfTheFaultThatEndsTheRun) {
  processor.ram()[0x100] = 1;
  EXPECT_THROW(run("faults_unhandled"), FaultError);
  ASSERT_EQ(debugger.fault_texts.size(), 1U);
  EXPECT_EQ(debugger.fault_texts[0], faults.at(0).text);
}

TEST_F(Debugged, IsPolledNowAndThen) {
  system.on_keep_up = [this] {
    if (debugger.polls == 3) processor.stop();
  };
  processor.ram()[0x100] = 1;
  run("waiting");
  EXPECT_EQ(debugger.polls, 3U);
}

}  // namespace
}  // namespace dsdpv1::arm

#include <gmock/gmock.h>

#include "tests/arm/processor_bench.hpp"

namespace arm {
namespace {

class Execution : public ProcessorBench {};

TEST_F(Execution, CountsInstructionsAndCyclesOneByOne) {
  run("arithmetic");
  EXPECT_EQ(r(1), 55U);
  EXPECT_EQ(r(2), 2U);
  EXPECT_EQ(r(3), 3U);
  // 2 + 10 * 3, cmp, IT with three, ldr, str
  EXPECT_EQ(processor.instructions(), 2 + 30 + 1 + 4 + 2U);
  EXPECT_EQ(processor.cycles(), processor.instructions());
  EXPECT_TRUE(faults.empty());
}

TEST_F(Execution, InterruptsNestByPriority) {
  run("interrupts");
  EXPECT_THAT(system.notes, testing::ElementsAre(1U, 10U, 20U, 0xFFFFFFF1U, 11U, 16U, 2U));
  EXPECT_TRUE(faults.empty());
}

}  // namespace
}  // namespace arm

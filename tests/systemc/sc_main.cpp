#include <gtest/gtest.h>

#include <systemc>

#include "tests/systemc/bench.hpp"

int sc_main(int argc, char* argv[]) {
  testing::InitGoogleTest(&argc, argv);
  if (!testing::GTEST_FLAG(list_tests)) simulate();
  return RUN_ALL_TESTS();
}

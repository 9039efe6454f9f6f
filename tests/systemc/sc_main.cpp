#include <gtest/gtest.h>

#include <iostream>
#include <systemc>

#include "model/systemc/main_stack.hpp"
#include "tests/systemc/bench.hpp"

int sc_main(int argc, char* argv[]) {
  testing::InitGoogleTest(&argc, argv);
  try {
    if (!testing::GTEST_FLAG(list_tests)) dsdpv1::simulate();
  } catch (const sc_core::sc_report& report) {  // SystemC would pass it to a handler that a bench has replaced
    std::cerr << report.what() << "\n";
    return 1;
  }
  dsdpv1::systemc::announce_main_stack();
  return RUN_ALL_TESTS();
}

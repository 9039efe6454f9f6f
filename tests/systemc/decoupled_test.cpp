// The user CPU with the C driver, coupled to simulation time and decoupled from it, at 1 fs and at 1 ps: the chip, its
// bus, its DPRAM and the CPU behave identically at the same ticks.
#include <gtest/gtest.h>

#include "tests/systemc/own_process.hpp"
#include "tests/systemc/platform.hpp"

namespace dsdpv1 {

using sc_core::sc_time;

namespace {

struct Told {
  std::string all;
  std::uint64_t accesses = 0, ahead = 0, deltas = 0;
};

Told run(double femtoseconds, double quantum_us) {
  const std::string text = in_a_process_of_its_own([=] {
    sc_core::sc_set_time_resolution(femtoseconds, sc_core::SC_FS);
    tlm::tlm_global_quantum::instance().set(sc_time(quantum_us, sc_core::SC_US));
    platform::Platform platform;
    sc_core::sc_start(platform::to_time(platform::kEnd));
    std::ostringstream out;
    out << platform.cpu.accesses() << " " << platform.cpu.accesses_ahead() << " " << sc_core::sc_delta_count() << "\n";
    return out.str() + platform.told();
  });
  Told told;
  std::istringstream(text) >> told.accesses >> told.ahead >> told.deltas;
  told.all = text.substr(text.find('\n') + 1);
  return told;
}

const Told& coupled() {
  static const Told once = run(1, 0);
  return once;
}

}  // namespace

void simulate() {}

TEST(Decoupled, TheDriverBringsTheChipUpAndExchangesData) {
  for (const char* said : {"ready: success", "initialised: success", "parameters, 2 bytes", "configuration, 2 bytes",
                           "outputs 0\n", "outputs 11\n"})
    EXPECT_NE(coupled().all.find(said), std::string::npos) << said;
  EXPECT_EQ(coupled().ahead, 0U);
}

TEST(Decoupled, WithAQuantumEverythingHappensAtTheSameTick) {
  for (const double quantum_us : {0.5, 10., 1000.}) {
    const Told decoupled = run(1, quantum_us);
    EXPECT_EQ(first_difference(decoupled.all, coupled().all), "") << quantum_us << " us";
    EXPECT_EQ(decoupled.accesses, coupled().accesses);
  }
}

TEST(Decoupled, WithAQuantumMostAccessesCostTheKernelNothing) {
  const Told decoupled = run(1, 10);
  EXPECT_GT(decoupled.ahead * 2, decoupled.accesses);
  EXPECT_LT(decoupled.deltas + decoupled.ahead, coupled().deltas);
}

TEST(Decoupled, AtAPicosecondEverythingHappensAtTheSameTick) {
  EXPECT_EQ(first_difference(run(1000, 0).all, coupled().all), "");
  EXPECT_EQ(first_difference(run(1000, 10).all, coupled().all), "");
}

TEST(Decoupled, AStationThatAddsUpRoundedTimesIsHeardAtAPicosecond) {
  const auto answered = [](bool adds_up) {
    return in_a_process_of_its_own([=] {
      sc_core::sc_set_time_resolution(1, sc_core::SC_PS);
      collect_reports();
      platform::Platform platform(adds_up);
      sc_core::sc_start(platform::to_time(platform::kEnd));
      return std::to_string(platform.station.answered()) + " characters, " + std::to_string(reports().size()) +
             " reports";
    });
  };
  EXPECT_EQ(answered(false), "198 characters, 0 reports");
  EXPECT_EQ(answered(true), answered(false));
}

}  // namespace dsdpv1

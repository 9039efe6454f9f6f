// The time resolution is a property of the process: each test sets it in a new process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/systemc/bench.hpp"
#include "tests/systemc/own_process.hpp"

namespace dsdpv1 {
namespace {

/// The outcome of a module at this resolution; 0: no resolution is set before.
std::string module_at(double value, sc_core::sc_time_unit unit, bool throws = true) {
  return in_a_process_of_its_own([=]() -> std::string {
    if (throws)
      collect_reports();
    else
      sc_core::sc_report_handler::set_actions(sc_core::SC_ERROR, sc_core::SC_DO_NOTHING);
    if (value > 0) sc_core::sc_set_time_resolution(value, unit);
    try {
      dsdpv1::systemc::TlmModule chip("chip");
    } catch (const sc_core::sc_report& report) {
      return std::string(report.get_msg_type()) + ": " + report.get_msg();
    } catch (const std::runtime_error& error) {
      return std::string("refused: ") + error.what();
    }
    return "accepted " + sc_core::sc_get_time_resolution().to_string();
  });
}

}  // namespace

void simulate() {}

TEST(Resolution, AModuleTakesThatOfThePlatform) {
  EXPECT_EQ(module_at(1, sc_core::SC_FS), "accepted 1 fs");
  EXPECT_EQ(module_at(100, sc_core::SC_FS), "accepted 100 fs");
  EXPECT_EQ(module_at(1, sc_core::SC_PS), "accepted 1 ps");
  EXPECT_EQ(module_at(0, sc_core::SC_FS), "accepted 1 ps");  // SystemC's default
}

TEST(Resolution, ACoarserOneThanAPicosecondIsAClearError) {
  EXPECT_EQ(module_at(1, sc_core::SC_NS),
            "/dsdpv1/time_resolution: the SystemC time resolution is 1 ns, expected 1 fs to 1 ps (a tick of the chip "
            "is 83.3 ps): call sc_core::sc_set_time_resolution(1, sc_core::SC_PS) before the first sc_time is made");
  EXPECT_THAT(module_at(10, sc_core::SC_PS), testing::HasSubstr("resolution is 10 ps, expected 1 fs to 1 ps"));
  EXPECT_THAT(module_at(10, sc_core::SC_PS, false), testing::StartsWith("refused: "));  // whatever an error's action
}

TEST(Resolution, WhoWantsAFemtosecondTooLateIsToldSo) {
  const auto want = [](bool too_late) {
    return in_a_process_of_its_own([=]() -> std::string {
      collect_reports();
      if (too_late) const sc_core::sc_time made_too_early(1, sc_core::SC_NS);
      try {
        dsdpv1::systemc::require_femtoseconds();
      } catch (const sc_core::sc_report& report) {
        return report.get_msg();
      }
      return sc_core::sc_get_time_resolution().to_string();
    });
  };
  EXPECT_EQ(want(false), "1 fs");
  EXPECT_EQ(want(true),
            "the SystemC time resolution is fixed at 1 ps, 1 fs is wanted: call "
            "dsdpv1::systemc::require_femtoseconds() before the first sc_time is made");
}

}  // namespace dsdpv1

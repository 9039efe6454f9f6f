// The time resolution is a property of the process: this one has fixed it at SystemC's default before the module is
// made.
#include <gtest/gtest.h>

#include "tests/systemc/bench.hpp"

void simulate() { collect_reports(); }

TEST(Resolution, AResolutionFixedEarlierIsAClearError) {
  const sc_core::sc_time made_too_early(1, sc_core::SC_NS);
  try {
    dsdpv1::systemc::TlmModule chip("chip");
    FAIL() << "accepted " << sc_core::sc_get_time_resolution();
  } catch (const sc_core::sc_report& report) {
    EXPECT_STREQ(report.get_msg_type(), "/dsdpv1/time_resolution");
    EXPECT_STREQ(
        report.get_msg(),
        "the SystemC time resolution is fixed at 1 ps, 1 fs is needed: call dsdpv1::systemc::require_femtoseconds() "
        "before the first sc_time is made");
  }
}

// One stimulus at 1 fs and at 1 ps, each in a separate process: all reports of the modules and their signals must be
// the same, in ticks.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/systemc/own_process.hpp"
#include "tests/systemc/stimulated.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::to_tick;
using stimulated::StimulatedPins;

namespace {

void list(std::ostream& out, const char* what, const Changes& changes) {
  out << what << ", " << changes.size() << " changes\n";
  for (const Change& change : changes) out << change << "\n";
}

void list(std::ostream& out, const char* what, const StimulatedPins& pins) {
  list(out, what, pins.changes);
  list(out, "as signals", pins.signals);
  out << "beside their ticks' times " << pins.off_time << "\n";
  for (const auto& [at, levels] : pins.data_bus) out << "D at tick " << to_tick(at) << " = " << levels << "\n";
}

/// The complete report of a run at this resolution.
std::string told_at(double femtoseconds) {
  return in_a_process_of_its_own([=] {
    sc_core::sc_set_time_resolution(femtoseconds, sc_core::SC_FS);
    collect_reports();
    stimulated::World world;
    sc_core::sc_start(dsdpv1::systemc::to_time(stimulated::kEnd));
    std::ostringstream out;
    list(out, "unbound", world.unbound);
    list(out, "step", world.step);
    list(out, "shifted", world.shifted);
    list(out, "bound", world.bound);
    list(out, "tlm", world.tlm.changes);
    for (const int byte : world.tlm.read) out << "read " << byte << "\n";
    for (const auto& [id, text] : reports()) out << id << ": " << text << "\n";
    return out.str();
  });
}

}  // namespace

void simulate() {}

TEST(TwoResolutions, TheWholeTraceOfPinsIsTheSame) {
  const std::string fine = told_at(1);
  EXPECT_GT(std::count(fine.begin(), fine.end(), '\n'), 2000);
  for (const double coarser : {10., 100., 1000.})
    EXPECT_EQ(first_difference(told_at(coarser), fine), "") << coarser << " fs";
}

}  // namespace dsdpv1

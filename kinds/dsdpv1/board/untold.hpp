#pragma once
// What firmware without a mailbox is not told, and what it does not tell: those parts of a scenario are refused, or
// left out.
#include <set>
#include <string>
#include <vector>

#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

struct Untold {
  std::set<const void*> left_out;  ///< actions and expectations of the scenario, by address
  std::vector<std::string> notes;  ///< for the end of the run
};

/// For a slave whose `firmware` has no mailbox. Throws InputError for the first thing that the scenario demands of its
/// program by name, unless its user_cpu says `without_mailbox: leave_out`. Settings of the file are no demands to
/// firmware that the command line has put in the place of the file's: those are noted.
Untold untold(const scenario::Scenario& scenario, const scenario::Slave& slave, const std::string& firmware);

}  // namespace dsdpv1::tb

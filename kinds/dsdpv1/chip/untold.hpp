#pragma once
// Firmware without a mailbox, and a process of the host, receive no commands and report nothing: the parts of a
// scenario that need these are rejected or left out.
#include <set>
#include <string>
#include <vector>

#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

struct Untold {
  std::set<const void*> left_out;  ///< actions and expectations of the scenario, by address
  std::vector<std::string> notes;  ///< for the end of the run
};

/// For a slave whose program, the file `path`, cannot be told anything; `because`: why, as "has no mailbox". Throws
/// InputError for the first demand of the scenario on that program, unless its user_cpu has
/// `without_mailbox: leave_out`. Settings of the file are not demands if the command line replaced the file's program:
/// those are noted.
Untold untold(const scenario::Scenario& scenario, const scenario::Slave& slave, const std::string& path,
              const std::string& because);

}  // namespace dsdpv1::tb

#pragma once
// Firmware without a mailbox, and a process of the host, receive no commands and report nothing: the parts of a
// scenario that need these are rejected or left out.
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "kinds/board/board_keys.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

struct Untold {
  std::set<const void*> left_out;  ///< actions and expectations of the scenario, by address
  std::vector<std::string> notes;  ///< for the end of the run
};

/// A program that cannot be told anything.
struct UntoldProgram {
  std::string path;
  std::string because;                     ///< why, as "has no mailbox"
  std::optional<WithoutMailbox> how = {};  ///< absent: of a program without such a key
  const char* driver_errors = "";          ///< what the codes of its driver begin with
  const char* not_for_it = "";             ///< an order that it need not be told
};

/// Throws InputError for the first demand of the scenario on the program of that slave, unless it is left out. Settings
/// of the file are not demands if the command line replaced the file's program: those are noted.
Untold untold(const scenario::Scenario& scenario, const scenario::Slave& slave, UntoldProgram program);

}  // namespace dsdpv1::tb

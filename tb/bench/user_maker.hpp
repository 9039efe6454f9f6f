#pragma once
// The user CPU that a scenario asks for.
#include <set>

#include "tb/bench/slave_station.hpp"

namespace tb {

/// `--gdb`: the debugger of an ARM board.
struct GdbRequest {
  int port = 0;
  std::function<void(const std::string&)> say;  ///< a line for the user
  std::function<bool()> stopped;                ///< whether the run is to end
};

/// What makes the slave's user CPU at each release of its reset. Throws InputError where its firmware is no use. All of
/// them must outlive the result; `gdb` is null without a debugger. What firmware without a mailbox cannot do of the
/// scenario is added to `left_out`, see untold.hpp.
MakeUser user_maker(const scenario::Scenario& scenario, const scenario::Slave& slave, ChipView& chip,
                    const GdbRequest* gdb, std::set<const void*>& left_out);

}  // namespace tb

#pragma once
// The user CPU that a scenario asks for.
#include "tb/bench/slave_station.hpp"

namespace tb {

/// `--gdb`: the debugger of an ARM board.
struct GdbWish {
  int port = 0;
  std::function<void(const std::string&)> say;  ///< a line for the user
  std::function<bool()> stopped;                ///< whether the run is to end
};

/// What makes the slave's user CPU at each release of its reset. Throws InputError where its firmware is no use. All of them
/// must outlive the result; `gdb` is null without a debugger.
MakeUser user_maker(const scenario::Scenario& scenario, const scenario::Slave& slave, ChipView& chip,
                    const GdbWish* gdb);

}  // namespace tb

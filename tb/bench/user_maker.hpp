#pragma once
// The user CPU that a scenario asks for.
#include "tb/bench/slave_station.hpp"

namespace tb {

/// What makes the slave's user CPU at each release of its reset. Throws InputError where its firmware is no use. All three
/// must outlive the result.
MakeUser user_maker(const scenario::Scenario& scenario, const scenario::Slave& slave, ChipView& chip);

}  // namespace tb

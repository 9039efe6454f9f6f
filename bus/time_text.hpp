#pragma once
// Times as people read them.
#include <string>

#include "bus/time.hpp"

namespace dsdpv1::bus {

/// A length of time for people, in the unit that leaves 1 to 999: "9.956 ms".
std::string short_time(Tick ticks);

/// A point in time for people, in the same unit, to the nanosecond or finer: "5.000021 ms", "63.280 us", "120.000 ms".
std::string moment_text(Tick ticks);

/// A point in time for logs and programs, in nanoseconds: "1361750.083". From 0 on.
std::string nanoseconds_text(Tick ticks);

}  // namespace dsdpv1::bus

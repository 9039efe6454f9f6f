#pragma once
// Timing diagrams of the DSDPV1's pins for reports: handshake (5.1), accesses (5.2, table 15), INTR0, and the answer on
// the line.
#include <vector>

#include "tb/chip/timing_diagram.hpp"

namespace dsdpv1::tb {

const std::vector<TimingDiagram>& dsdpv1_timing_diagrams();
const std::vector<BusyTime>& dsdpv1_busy_times();

}  // namespace dsdpv1::tb

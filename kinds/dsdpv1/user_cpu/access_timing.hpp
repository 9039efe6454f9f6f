#pragma once
// When a CPU moves its bus pins during one access to the DPRAM: as the chip's own interface has it.
#include "model/dsdpv1/host_access.hpp"

namespace dsdpv1::user_cpu {}  // namespace dsdpv1::user_cpu

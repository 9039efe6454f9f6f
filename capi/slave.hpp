#pragma once
// Converts a master's data about a slave between the header's and the bus's format.
#include "bus/master/slave_parameters.hpp"
#include "dsdpv1/gsd.h"

namespace dsdpv1::capi {

/// Throws for lengths beyond the arrays; the bus checks the rest.
bus::SlaveParameters parameters_of(const dpsim_slave& slave);
/// All members except `size`.
dpsim_slave slave_of(const bus::SlaveParameters& parameters);

}  // namespace dsdpv1::capi

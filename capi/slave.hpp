#pragma once
// What a master has to know of a slave, as the header and as the bus has it.
#include "bus/master/slave_parameters.hpp"
#include "dsdpv1/gsd.h"

namespace dsdpv1::capi {

/// Throws for lengths beyond the arrays; the bus judges the rest.
bus::SlaveParameters parameters_of(const dpsim_slave& slave);
/// All but `size`.
dpsim_slave slave_of(const bus::SlaveParameters& parameters);

}  // namespace dsdpv1::capi

#pragma once
// The table of what docs/chip.md rules, and the table of its parameters: what pins can show of each.
#include "lab/calibrate/claims.hpp"

namespace dsdpv1::calibrate {

/// What calibrate can see of the DSDPV1.
const Claims& dsdpv1_claims();

}  // namespace dsdpv1::calibrate

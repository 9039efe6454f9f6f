#pragma once
// The rulings of docs/chip.md and the parameters in tables, each with the evidence that pins can give.
#include "lab/calibrate/claims.hpp"

namespace dsdpv1::calibrate {

/// The claims about the DSDPV1 that calibrate can check.
const Claims& dsdpv1_claims();

}  // namespace dsdpv1::calibrate

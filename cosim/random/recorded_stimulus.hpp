#pragma once
// The inputs that a chip got in a lockstep run, as a stimulus that sets them again at the same ticks.
#include <vector>

#include "cosim/lockstep.hpp"
#include "cosim/random/stimulus.hpp"

namespace dsdpv1::cosim {

/// `inputs`: those of Lockstep::inputs up to `end`. The line becomes `send` where whole characters fit, else `spike`;
/// the user's edges become `pin`, those of one access joined for the shrinker. No second user reads meanwhile.
/// The kind must have RandomCases.
Stimulus recorded_stimulus(const std::vector<InputChange>& inputs, Tick end, const tb::ChipKind& kind);

}  // namespace dsdpv1::cosim

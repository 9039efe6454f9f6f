#pragma once
// Constrained-random stimulus: telegrams right and wrong, a user with and without manners, resets, changes of the baud
// rate.
#include <cstdint>

#include "cosim/random/random_setup.hpp"
#include "cosim/random/stimulus.hpp"
#include "model/dsdpv1/config.hpp"

namespace dsdpv1::cosim {

/// One case from power-on, the same for the same seed; with a serial port of the DSDPV1-RSU, straps for it come first.
/// Meant for a chip with times about as short as those of `quick_config()`: what has to be waited for is waited for
/// with the times of `config`. Runs for a few hundred thousand cycles, some for two millions (slow rates).
Stimulus random_stimulus(std::uint64_t seed, HostMode mode = HostMode::kParallel,
                         const dsdpv1::Config& config = quick_config());

}  // namespace dsdpv1::cosim

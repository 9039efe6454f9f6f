#pragma once
// With which parameters of the chip stimuli are played.
#include <string>
#include <vector>

#include "cosim/random/player.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::cosim {

/// The kind of chip that stimuli are for.
const tb::ChipKind& chip_kind(Part part = {});

/// For RTL of a user's own: the parameters that scenarios have. For the reference RTL see quick_options().
PlayOptions own_rtl_options(Part part, const Tolerances& tolerances);

/// Texts of --set, chip.KEY=VALUE: the keys of a scenario's chip. Throws tb::InputError.
void set_parameters(PlayOptions& options, const std::vector<std::string>& settings);

/// Model and RTL with the parameters of `options`, side by side.
std::unique_ptr<Lockstep> make_lockstep(const PlayOptions& options, std::unique_ptr<Rtl> rtl);

/// The reference RTL with the parameters of `options` and, unless it is 0, a single fault of rtl_ref/dsdpv1/faults.txt.
MakeTop reference_top(const PlayOptions& options, unsigned fault, std::uint32_t seed);

}  // namespace dsdpv1::cosim

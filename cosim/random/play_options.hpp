#pragma once
// What a stimulus is played to: model and RTL with the parameters of --set.
#include <memory>
#include <string>
#include <vector>

#include "cosim/random/player.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::cosim {

/// The settings of a scenario's chip with texts of --set, chip.KEY=VALUE. Throws tb::InputError.
std::shared_ptr<const tb::OwnSettings> chip_settings(const tb::ChipKind& kind, const std::vector<std::string>& set);

/// The parameters that scenarios have.
PlayOptions usual_options(const tb::ChipKind& kind = *tb::chip_kinds().front());
/// ... with short times: how random cases and directed stimuli are played on the reference RTL.
PlayOptions quick_options(const tb::ChipKind& kind = *tb::chip_kinds().front());

/// Others behind those that there are. Throws tb::InputError.
void set_parameters(PlayOptions& options, const std::vector<std::string>& set);

/// Model and RTL with the parameters of `options`, side by side.
std::unique_ptr<Lockstep> make_lockstep(const PlayOptions& options, std::unique_ptr<Rtl> rtl);

/// The reference RTL with the parameters of `options` and, unless it is 0, a single fault of the kind's list.
MakeTop reference_top(const PlayOptions& options, unsigned fault, std::uint32_t seed);

/// RandomCases::make_case of this seed.
Stimulus random_case(std::uint64_t seed, const PlayOptions& options);

}  // namespace dsdpv1::cosim

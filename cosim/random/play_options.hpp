#pragma once
// The environment in which a stimulus is played: model and RTL with the parameters of --set.
#include <memory>
#include <string>
#include <vector>

#include "cosim/random/player.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::cosim {

/// The settings of a scenario's chip, changed by texts of --set, chip.KEY=VALUE. Throws tb::InputError.
std::shared_ptr<const tb::OwnSettings> chip_settings(const tb::ChipKind& kind, const std::vector<std::string>& set);

/// The parameters of a scenario, changed by its --set, as texts chip.KEY=VALUE for rtl-random: those that it sets, and
/// those that quick_options would make short. `chip`: its settings.
std::vector<std::string> chip_settings_of(const std::string& scenario, const std::vector<std::string>& set,
                                          const tb::ChipKind& kind, const tb::OwnSettings& chip);

/// The default parameters of scenarios.
PlayOptions usual_options(const tb::ChipKind& kind = *tb::chip_kinds().front());
/// ... with short times, for random cases and directed stimuli on the reference RTL.
PlayOptions quick_options(const tb::ChipKind& kind = *tb::chip_kinds().front());

/// Adds more parameters after the present ones. Throws tb::InputError.
void set_parameters(PlayOptions& options, const std::vector<std::string>& set);

/// Lockstep of model and RTL with the parameters of `options`.
std::unique_ptr<Lockstep> make_lockstep(const PlayOptions& options, std::unique_ptr<Rtl> rtl);

/// The reference RTL with the parameters of `options` and, if `fault` is not 0, a single fault of the kind's list.
MakeTop reference_top(const PlayOptions& options, unsigned fault, std::uint32_t seed);

/// RandomCases::make_case of this seed.
Stimulus random_case(std::uint64_t seed, const PlayOptions& options);

}  // namespace dsdpv1::cosim

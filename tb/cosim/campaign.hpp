#pragma once
// Many random cases, the shrinking of one that fails, and the fault campaign.
#include <functional>
#include <string>
#include <vector>

#include "tb/cosim/player.hpp"

namespace cosim {

struct CampaignResult {
  MatchCounts counts;
  std::uint64_t cases = 0;
  std::uint64_t failed_seed = 0;         ///< of the case with the difference
  std::optional<Difference> difference;  ///< the first one
};

/// The seed of case `number` of a campaign.
std::uint64_t case_seed(std::uint64_t campaign, std::uint64_t number);

/// Cases one after the other until so many cycles are compared, or one differs. `progress` may be empty.
CampaignResult run_campaign(std::uint64_t seed, std::uint64_t cycles, const MakeTop& make,
                            const std::function<void(const CampaignResult&)>& progress);

/// A shorter stimulus that still differs: actions are left out, then delays and faults, as long as there is a difference. At most
/// `runs` runs.
Stimulus shrink(Stimulus stimulus, const MakeTop& make, int runs);

struct Fault {
  unsigned number = 0;
  std::string block, text;
};
/// rtl_ref/faults.txt; throws tb::InputError.
std::vector<Fault> read_faults(const std::string& path);

struct Kill {
  Fault fault;
  bool found = false;
  std::string stimulus;  ///< name of the directed stimulus or "random"
  std::uint64_t cycles = 0;
  std::string what;  ///< the difference
};

struct NamedStimulus {
  std::string name;
  Stimulus stimulus;
};

/// Directed stimuli first, then random cases until `cycles` are compared.
Kill hunt(const Fault& fault, const std::vector<NamedStimulus>& directed, std::uint64_t seed, std::uint64_t cycles);
/// One line of the kill table.
std::string line_of(const Kill& kill);

}  // namespace cosim

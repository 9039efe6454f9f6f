#pragma once
// The fault campaign tests the checker: every single fault that can be planted in the RTL must be found.
#include <string>
#include <vector>

#include "cosim/random/campaign.hpp"

namespace dsdpv1::cosim {

struct Fault {
  unsigned number = 0;
  std::string block, stimulus, text;  ///< the directed stimulus that is played first
  std::vector<std::string> set = {};  ///< settings of the chip for its hunt, as chip.fcb_rule=content
};
/// A list as rtl_ref/dsdpv1/faults.txt; throws tb::InputError.
std::vector<Fault> read_faults(const std::string& path);

struct NamedStimulus {
  std::string name;
  Stimulus stimulus;
};
/// The stimulus files of a folder, those with the shortest delays first; throws tb::InputError.
std::vector<NamedStimulus> read_stimuli(const std::string& folder, const tb::ChipKind& kind);

struct Kill {
  Fault fault;
  bool found = false;
  std::string stimulus;      ///< name of the directed stimulus, or "random case N"
  std::uint64_t cycles = 0;  ///< played up to the difference
  double seconds = 0;
  std::string what;  ///< the difference
};

/// Makes RTL with this fault and these parameters.
using MakeFaulty = std::function<MakeTop(const Fault& fault, const PlayOptions& options)>;

/// Plays directed stimuli, first the one that the fault names, then random cases until `cycles` are compared. For the
/// chip and its port in `options`.
Kill hunt(const Fault& fault, const std::vector<NamedStimulus>& directed, const CampaignOptions& options,
          const MakeFaulty& make);

/// Hunts all faults on several threads; `found` is called in the order of `faults`, by one thread at a time.
std::vector<Kill> hunt_all(const std::vector<Fault>& faults, const std::vector<NamedStimulus>& directed,
                           const CampaignOptions& options, const MakeFaulty& make,
                           const std::function<void(const Kill&)>& found);

/// One line of the kill table; its heading.
std::string line_of(const Kill& kill);
std::string heading();
/// The table for other programs: tab-separated, with a heading.
std::string to_tsv(const std::vector<Kill>& kills);

}  // namespace dsdpv1::cosim

#pragma once
// Plays a stimulus on model and RTL in lockstep.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cosim/lockstep.hpp"
#include "cosim/random/coverage.hpp"
#include "cosim/random/play_listener.hpp"
#include "cosim/random/stimulus.hpp"

namespace dsdpv1::cosim {

/// Makes the RTL for one run; each run gets a new one.
using MakeTop = std::function<std::unique_ptr<Rtl>()>;

/// See play_options.hpp.
struct PlayOptions {
  const tb::ChipKind* kind;                          ///< has RandomCases
  std::vector<std::string> set = {};                 ///< texts of --set: the parameters, in sequence
  std::shared_ptr<const tb::OwnSettings> chip = {};  ///< the resulting settings
  tb::Engine engine = tb::Engine::kSkip;
  LockstepOptions lockstep = {};
  bool reads_back = false;     ///< ReadBack acts between the user's actions: the RTL's memory cannot be compared
  std::string wave = {};       ///< for the wave of a difference; empty: none
  Tick limit = Tick{1} << 50;  ///< the run ends here at the latest
  std::vector<PlayListener*> listeners = {};
};

struct PlayResult {
  std::optional<Difference> difference;
  MatchCounts counts;
  std::size_t actions_begun = 0;  ///< up to the difference, or to the end
  Coverage coverage;
};

/// Until the first difference, or until all lanes have finished and some cycles more.
PlayResult play(const Stimulus& stimulus, const MakeTop& make, const PlayOptions& options);

}  // namespace dsdpv1::cosim

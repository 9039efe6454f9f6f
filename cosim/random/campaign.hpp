#pragma once
// Runs many random cases on several threads, and shrinks a failing one.
#include <functional>
#include <string>
#include <vector>

#include "cosim/random/coverage.hpp"
#include "cosim/random/play_options.hpp"
#include "cosim/random/situations.hpp"

namespace dsdpv1::cosim {

/// Makes RTL with these parameters.
using MakeTopFor = std::function<MakeTop(const PlayOptions&)>;

struct CampaignOptions {
  std::uint64_t seed = 1, cycles = 0;  ///< cases are begun until so many cycles are compared
  unsigned jobs = 1;                   ///< threads
  PlayOptions play = quick_options();
  std::uint64_t first_case = 0;    ///< number of the first one
  MakeTopFor make_for = {};        ///< each case has its RandomCases::case_settings; empty: no settings
  bool counts_situations = false;  ///< costs a few percent
};

/// The same for the same seed and cycles, independent of the number of threads.
struct CampaignResult {
  MatchCounts counts;
  Coverage coverage;
  Situations situations;
  std::uint64_t cases = 0;                   ///< up to and including the one with the difference
  std::uint64_t failed_seed = 0;             ///< of the case with the difference
  std::vector<std::string> failed_settings;  ///< its RandomCases::case_settings
  std::optional<Difference> difference;      ///< of the first case that has one
};

/// Progress of the comparison; called by one thread at a time.
using CampaignProgress = std::function<void(std::uint64_t cases, std::uint64_t cycles)>;

/// The seed of case `number` of a campaign. Modulo kLedCases it is number + 1 in the first cases, whose subjects are
/// fixed (RandomCases::make_case), and 0 in the others.
std::uint64_t case_seed(std::uint64_t campaign, std::uint64_t number);

/// Runs cases until so many cycles are compared, or one differs. All threads call `make`; `progress` may be empty.
CampaignResult run_campaign(const CampaignOptions& options, const MakeTop& make, const CampaignProgress& progress = {});

/// Finds a shorter stimulus that still differs: removes actions, then delays and faults, as long as there is a
/// difference. At most `runs` runs, each with `options`.
Stimulus shrink(Stimulus stimulus, const MakeTop& make, int runs, const PlayOptions& options = quick_options());

/// Calls `work` on so many threads, each until it returns false; rethrows the first exception.
void in_parallel(unsigned jobs, const std::function<bool()>& work);

}  // namespace dsdpv1::cosim

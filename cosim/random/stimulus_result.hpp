#pragma once
// The result of random cases or of a played stimulus, for programs: one JSON object (docs/cosim.md).
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cosim/lockstep.hpp"
#include "cosim/random/coverage.hpp"
#include "cosim/random/situations.hpp"

namespace dsdpv1::cosim {

struct StimulusResult {
  const tb::ChipKind* kind = tb::chip_kinds().front();
  std::string mode;    ///< HostPort::word of random cases; empty: the first one
  std::string rtl;     ///< folder of the user's RTL; empty: the reference RTL
  unsigned fault = 0;  ///< of the reference RTL
  std::uint64_t seed = 1;
  std::string replayed;         ///< the stimulus file that was played; empty: random cases
  std::uint64_t cases = 0;      ///< random ones, up to and including the one that differs
  std::uint64_t case_seed = 0;  ///< of the one that differs
  MatchCounts counts;
  Coverage coverage;
  Situations situations;                 ///< of random cases ...
  std::vector<Situation> known;          ///< ... and those that may occur
  std::vector<std::string> documents;    ///< of the rulings that are counted
  std::optional<Difference> difference;  ///< of the stimulus in `stimulus`, or of the one that was played
  std::string stimulus;                  ///< file of the shrunk failing case
  std::size_t actions = 0;               ///< ... and its length
};

/// Indented, with a line end.
std::string result_json(const StimulusResult& result);
/// Its JSON Schema (draft 2020-12): exact, other members are invalid.
std::string stimulus_result_schema();
/// The table of docs/cosim.md.
std::string stimulus_result_table();

}  // namespace dsdpv1::cosim

#pragma once
// Model and RTL in lockstep without a scenario: of rtl-random, and of cosim, whose stimulus is played so.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "apps/options/rtl_options.hpp"
#include "cosim/lockstep.hpp"

namespace dsdpv1::app {

struct RtlRandomArguments {
  std::string command = "dsdpv1-sim rtl-random";  ///< for messages
  RtlChip chip;                                   ///< of the RTL
  std::uint64_t cycles = 10'000'000, seed = 1;
  unsigned jobs = 0;                           ///< threads; 0: as many as there are processors
  std::string replay;                          ///< a stimulus file instead of random cases
  unsigned fault = 0;                          ///< of the RTL, to see one found
  std::string stimulus = "lockstep.stimulus";  ///< where a shrunk failing case goes
  std::string difference = "lockstep.vcd";     ///< ... and its wave
  OwnRtlArguments own;                         ///< without a folder: the reference RTL
  std::vector<std::string> set;                ///< chip.KEY=VALUE: parameters of the model
  std::vector<std::string> told;               ///< the same in a stimulus, which `set` changes
  std::string wave, log, result, tsv;          ///< empty: none
  bool campaign = false;                       ///< all four host ports in turn, kept in `state`
  std::string state = "rtl-campaign";          ///< folder
  bool wave_save = false;
  bool shrink = false;    ///< the stimulus of `replay`, when it differs
  bool no_dpram = false;  ///< the reference RTL is judged as the user's own: by its pins
};

/// Returns the exit code; throws tb::InputError.
int rtl_random(RtlRandomArguments arguments);

/// The inputs of a scenario's chip up to a difference.
struct ScenarioInputs {
  std::vector<cosim::InputChange> changes;
  cosim::Difference difference;
  std::shared_ptr<const tb::OwnSettings> chip;
  std::vector<std::string> set;  ///< the same as texts, for the stimulus
};

/// Plays these inputs to the RTL as a stimulus. If it shows the same difference, it goes into the file of --stimulus,
/// shortened.
void write_stimulus(const RtlRandomArguments& arguments, const ScenarioInputs& inputs, const OwnRtl& own);

}  // namespace dsdpv1::app

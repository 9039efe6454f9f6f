#pragma once
// rtl-random, rtl-faults: model and reference RTL in lockstep without a scenario. cosim: RTL of the user's own.
#include <cstdint>
#include <string>
#include <vector>

#include "apps/options/own_rtl.hpp"
#include "apps/options/wave_options.hpp"
#include "cosim/random/play_options.hpp"

namespace dsdpv1::app {

struct RtlRandomArguments {
  std::string command = "dsdpv1-sim rtl-random";  ///< for messages
  std::string chip = "dsdpv1";                    ///< kind of chip, for the reference RTL
  std::string mode = "parallel";                  ///< of the DSDPV1-RSU
  std::uint64_t cycles = 10'000'000, seed = 1;
  unsigned jobs = 0;                           ///< threads; 0: as many as there are processors
  std::string replay;                          ///< a stimulus file instead of random cases
  unsigned fault = 0;                          ///< of rtl_ref/faults.txt, to see one found
  std::string stimulus = "lockstep.stimulus";  ///< where a shrunk failing case goes
  std::string difference = "lockstep.vcd";     ///< ... and its wave
  OwnRtlArguments own;                         ///< without a folder: the reference RTL
  std::vector<std::string> set;                ///< chip.KEY=VALUE: parameters of the model
  std::string wave, log, result, tsv;          ///< empty: none
  bool campaign = false;                       ///< all four host ports in turn, kept in `state`
  std::string state = "rtl-campaign";          ///< folder
  bool wave_save = false;
};

struct RtlFaultsArguments {
  std::string chip = "dsdpv1", mode = "parallel";  ///< as of rtl-random
  std::string list, directed;                      ///< empty: those of the program's own sources, wherever it is called
  std::string tsv;                                 ///< the kill table for other programs; empty: none
  std::uint64_t cycles = 30'000'000, seed = 1;
  unsigned jobs = 0;  ///< as of rtl-random
};

struct CosimArguments {
  OwnRtlArguments own;
  std::string scenario, replay;  ///< one of them: a stimulus file, as of RtlRandomArguments
  std::string difference = "lockstep.vcd";
  WaveArguments wave;  ///< file, from and to; its inside is always there
  std::string log, result;
  std::string checks;  ///< as of RunArguments
  bool log_whole = false;
  std::vector<std::string> set;  ///< as of RunArguments
};

/// What --chip and --mode say. Throws tb::InputError: a chip without reference RTL, or a mode that it does not have.
Part part_of(const std::string& chip);
HostMode mode_of(Part part, const std::string& mode);

/// Threads for --jobs; 0: one a processor.
unsigned threads_of(unsigned jobs);

int rtl_random(const RtlRandomArguments& arguments);
int rtl_faults(const RtlFaultsArguments& arguments);
int cosim_own_rtl(const CosimArguments& arguments);

}  // namespace dsdpv1::app

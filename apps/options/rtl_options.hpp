#pragma once
// Which RTL stands beside the model: the reference RTL of a chip, or RTL of the user's own.
#include <CLI/CLI.hpp>

#include <cstdint>
#include <functional>
#include <string>

#include "apps/options/outputs.hpp"
#include "cosim/pin_map.hpp"
#include "cosim/random/play_options.hpp"
#include "cosim/random/random_cases.hpp"
#include "cosim/user_rtl.hpp"
#include "lab/coverage/reached.hpp"

namespace dsdpv1::app {

/// --chip and --mode.
struct RtlChip {
  std::string chip = "dsdpv1";    ///< kind of chip
  std::string mode = "parallel";  ///< its host port

  /// Throws tb::InputError for one that rtl-random is not for.
  const tb::ChipKind& kind() const;
  /// Throws tb::InputError for a port that the chip does not have.
  const cosim::HostPort& port() const;
};
void add_chip_options(CLI::App& app, RtlChip& chip, bool with_mode = true);
/// --chip alone.
CLI::Option* add_chip_option(CLI::App& app, RtlChip& chip);
/// --fault: a single one in the RTL.
CLI::Option* add_fault_option(CLI::App& app, unsigned& fault);

/// --no-dpram: the reference RTL as if it were the user's own.
CLI::Option* add_no_dpram_option(CLI::App& app, bool& no_dpram);
struct OwnRtlArguments {
  std::string rtl, top, pins, build = "build/cosim";
  std::string coverage = {};  ///< lcov's tracefile of a run; empty: nothing is counted
};

struct OwnRtl {
  cosim::PinMap map;
  cosim::MakeUserRtl make;
  std::function<std::string()> counts;  ///< see cosim::BuiltUserRtl
};

/// Of --cycles, more than any campaign.
constexpr std::uint64_t kMostCycles = 1'000'000'000'000;

/// --coverage, which needs --rtl.
void add_coverage_option(CLI::App& app, OwnRtlArguments& arguments);

/// The file of --coverage, opened before the run, and what was reached. Does nothing without the option.
class CoverageFile {
 public:
  explicit CoverageFile(const OwnRtlArguments& arguments) : file_(arguments.coverage) {}

  /// Adds the counts since the last call.
  void add(const OwnRtl& own) { add(own.counts); }
  void add(const std::function<std::string()>& counts);
  /// Throws tb::InputError when it cannot be written.
  void write();

 private:
  WantedFile file_;
  tb::coverage::Files reached_;
};

/// Of any pin.
bool has_tolerance(const cosim::PinMap& map);

/// --rtl and what goes with it. `required`: the command is about nothing else.
void add_own_rtl_options(CLI::App& app, OwnRtlArguments& arguments, bool required);

/// A map of the pins and parameters of this kind. Throws tb::InputError.
cosim::PinMap load_map(const std::string& path, const tb::ChipKind& kind);
/// The map of its pins, the names of the reference RTL when there is none. Throws tb::InputError.
cosim::PinMap own_map(const OwnRtlArguments& arguments, const tb::ChipKind& kind);
/// The map and the sources in its folder, which no output may replace.
std::vector<NamedFile> own_inputs(const OwnRtlArguments& arguments);
/// Whether the map takes all these texts of --set, chip.KEY=VALUE, to the RTL.
bool takes(const cosim::PinMap& map, const std::vector<std::string>& set);

/// How random cases and stimuli are played: with short times, and those of `set`, unless RTL of the user's own cannot
/// be told them; RTL of his own by its pins alone. Throws tb::InputError.
cosim::PlayOptions play_options(const RtlChip& chip, const OwnRtlArguments& own, const std::vector<std::string>& set,
                                bool no_dpram);

/// Reads the map of its pins and builds it with the parameters of `chip`, `traced` so that its inside can be recorded,
/// for the single fault `fault`. `command` as "dsdpv1-sim cosim". Throws tb::InputError.
OwnRtl build_own_rtl(const OwnRtlArguments& arguments, const std::string& command, const tb::ChipKind& kind,
                     const tb::OwnSettings& chip, bool traced, unsigned fault = 0);

}  // namespace dsdpv1::app

// rtl-faults: every single fault in the reference RTL must be found.
#include "apps/commands/rtl_commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <vector>

#include "apps/command_line.hpp"
#include "apps/data_folder.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/outputs.hpp"
#include "cosim/random/faults.hpp"
#include "io/output/output_file.hpp"

namespace dsdpv1::app {
namespace {

std::vector<NamedFile> with_files_of(const std::string& folder, std::vector<NamedFile> inputs) {
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    inputs.push_back({"a file of --directed", entry.path()});
  return inputs;
}

}  // namespace

int rtl_faults(const RtlFaultsArguments& arguments) {
  leave_nothing_on_signals();
  const auto given_or_own = [](const std::string& path, const std::string& own) {
    return path.empty() ? data_folder() + own : path;
  };
  const Part part = part_of(arguments.chip);
  const std::string suffix = dsdpv1::row(part).rtl;
  const std::string list = given_or_own(arguments.list, "/rtl_ref/faults" + suffix + ".txt");
  const std::string folder = given_or_own(arguments.directed, "/tests/cosim/stimuli" + suffix);
  const std::vector<cosim::Fault> faults = cosim::read_faults(list);
  const std::vector<cosim::NamedStimulus> directed = cosim::read_stimuli(folder, part);
  check_outputs("dsdpv1-sim rtl-faults", with_files_of(folder, {{"--list", list}}), {{"--tsv", arguments.tsv}});
  std::optional<tb::OutputFile> tsv;
  if (!arguments.tsv.empty()) tsv.emplace(arguments.tsv);
  cosim::CampaignOptions options{arguments.seed, arguments.cycles / 10, threads_of(arguments.jobs),
                                 cosim::quick_options(part), mode_of(part, arguments.mode)};
  const cosim::Kill none =
      cosim::hunt({0, "none", "", "the build for the faults, with none active"}, directed, options);
  options.cycles = arguments.cycles;
  std::cout << cosim::heading();
  if (none.found) {
    std::cout << cosim::line_of(none) << "model and RTL differ without a fault; find that out first\n";
    return kFailed;
  }
  const std::vector<cosim::Kill> kills = cosim::hunt_all(
      faults, directed, options, [](const cosim::Kill& kill) { std::cout << cosim::line_of(kill) << std::flush; });
  if (tsv) {
    tsv->write(cosim::to_tsv(kills));
    tsv->commit();
  }
  const auto found = std::count_if(kills.begin(), kills.end(), [](const cosim::Kill& kill) { return kill.found; });
  std::cout << fmt::format("{} of {} faults found\n", found, faults.size());
  return found == static_cast<std::ptrdiff_t>(faults.size()) ? kPassed : kFailed;
}

}  // namespace dsdpv1::app

#include "apps/rtl_commands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include "apps/command_line.hpp"
#include "tb/cosim/campaign.hpp"
#include "tb/cosim/random_setup.hpp"
#include "tb/cosim/random_stimulus.hpp"
#include "tb/cosim/reference_rtl.hpp"
#include "tb/report/output_file.hpp"
#include "tb/scenario/input_error.hpp"
#include "tb/waves/wave_writer.hpp"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr int kShrinkRuns = 600;

cosim::Stimulus read_stimulus(const std::string& path) {
  std::ifstream file(path);
  if (!file || fs::is_directory(path)) throw tb::InputError(path, 0, "cannot be opened, allowed is a stimulus file");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return cosim::parse_stimulus(text, path);
}

std::string counts_text(const cosim::MatchCounts& counts) {
  return fmt::format("{} cycles, {} pin changes, {} DPRAM images the same", counts.cycles, counts.pin_changes,
                     counts.dpram_images);
}

cosim::MakeTop maker(unsigned fault, std::uint32_t seed) {
  if (fault != 0) return [fault, seed] { return cosim::make_faulty_rtl(cosim::quick_config(), fault, seed); };
  return [seed] { return cosim::make_reference_rtl(cosim::quick_config(), seed); };
}

int replay(const RtlRandomArguments& arguments, const std::string& path) {
  cosim::PlayOptions options;
  options.config = cosim::quick_config();
  options.wave = arguments.difference;
  const cosim::PlayResult result = cosim::play(read_stimulus(path), maker(arguments.fault, static_cast<std::uint32_t>(arguments.seed)), options);
  std::cout << path << ": " << counts_text(result.counts) << '\n';
  if (!result.difference) return kPassed;
  std::cout << cosim::describe(*result.difference) << "wave              " << arguments.difference << '\n';
  return kFailed;
}

void show(const cosim::CampaignResult& result) {
  if (isatty(STDERR_FILENO) != 0)
    std::cerr << fmt::format("\r{} cases, {:.1f} M cycles", result.cases,
                             static_cast<double>(result.counts.cycles) / 1e6);
}

}  // namespace

int rtl_random(const RtlRandomArguments& arguments) {
  tb::check_wave_name(arguments.difference);
  if (!arguments.replay.empty()) return replay(arguments, arguments.replay);
  const auto begin = std::chrono::steady_clock::now();
  const cosim::CampaignResult result =
      cosim::run_campaign(arguments.seed, arguments.cycles, maker(arguments.fault, static_cast<std::uint32_t>(arguments.seed)), show);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (isatty(STDERR_FILENO) != 0) std::cerr << '\r';
  std::cout << fmt::format("seed {}: {} cases, {} ({:.1f} M cycles/s)\n", arguments.seed, result.cases,
                           counts_text(result.counts), static_cast<double>(result.counts.cycles) / 1e6 / seconds);
  if (!result.difference) return kPassed;
  std::cout << fmt::format("case {} differs: {}\nshrinking it ...\n", result.cases, result.difference->what)
            << std::flush;
  const cosim::Stimulus shrunk =
      cosim::shrink(cosim::random_stimulus(result.failed_seed), maker(arguments.fault, static_cast<std::uint32_t>(arguments.seed)), kShrinkRuns);
  tb::OutputFile file(arguments.stimulus);
  file.write(cosim::to_text(shrunk));
  file.commit();
  std::cout << fmt::format("{} actions, to be seen again with --replay {}\n", shrunk.size(), arguments.stimulus);
  return replay(arguments, arguments.stimulus);
}

int rtl_faults(const RtlFaultsArguments& arguments) {
  const std::vector<cosim::Fault> faults = cosim::read_faults(arguments.list);
  std::vector<cosim::NamedStimulus> directed;
  if (!arguments.directed.empty()) {
    for (const auto& entry : fs::directory_iterator(arguments.directed))
      directed.push_back({entry.path().stem().string(), read_stimulus(entry.path().string())});
    std::sort(directed.begin(), directed.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  }
  const cosim::Kill none = cosim::hunt({0, "none", "the build for the faults, with none active"}, directed,
                                       arguments.seed, arguments.cycles / 10);
  if (none.found) {
    std::cout << cosim::line_of(none) << "model and RTL differ without a fault; find that out first\n";
    return kFailed;
  }
  std::size_t found = 0;
  for (const cosim::Fault& fault : faults) {
    const cosim::Kill kill = cosim::hunt(fault, directed, arguments.seed, arguments.cycles);
    found += kill.found ? 1 : 0;
    std::cout << cosim::line_of(kill) << std::flush;
  }
  std::cout << fmt::format("{} of {} faults found\n", found, faults.size());
  return found == faults.size() ? kPassed : kFailed;
}

}  // namespace app

#include "apps/rtl_commands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <optional>
#include <thread>
#include <vector>

#include "apps/command_line.hpp"
#include "apps/interrupt.hpp"
#include "apps/outputs.hpp"
#include "bus/printable.hpp"
#include "tb/dsdpv1/cosim/campaign.hpp"
#include "tb/dsdpv1/cosim/faults.hpp"
#include "tb/dsdpv1/cosim/random_setup.hpp"
#include "tb/dsdpv1/cosim/random_stimulus.hpp"
#include "tb/dsdpv1/cosim/reference_rtl.hpp"
#include "tb/input/input_error.hpp"
#include "tb/input/read_file.hpp"
#include "tb/output/output_file.hpp"
#include "tb/waves/wave_writer.hpp"

namespace app {
namespace {

constexpr int kShrinkRuns = 600;

cosim::Stimulus read_stimulus(const std::string& path) {
  return cosim::parse_stimulus(tb::read_file(path, tb::kStimulusFile), path);
}

std::string counts_text(const cosim::MatchCounts& counts) {
  return fmt::format("{} cycles, {} pin changes, {} DPRAM images the same", counts.cycles, counts.pin_changes,
                     counts.dpram_images);
}

cosim::MakeTop maker(const RtlRandomArguments& arguments) {
  const unsigned fault = arguments.fault;
  const auto seed = static_cast<std::uint32_t>(arguments.seed);
  if (fault != 0) return [fault, seed] { return cosim::make_faulty_rtl(cosim::quick_config(), fault, seed); };
  return [seed] { return cosim::make_reference_rtl(cosim::quick_config(), seed); };
}

int replay(const RtlRandomArguments& arguments, const cosim::Stimulus& stimulus, const std::string& path) {
  cosim::PlayOptions options;
  options.config = cosim::quick_config();
  options.wave = arguments.difference;
  const cosim::PlayResult result = cosim::play(stimulus, maker(arguments), options);
  std::cout << bus::printable(path) << ": " << counts_text(result.counts) << '\n' << result.coverage.text();
  if (!result.difference) return kPassed;
  std::cout << cosim::describe(*result.difference) << "wave              " << arguments.difference << '\n';
  return kFailed;
}

unsigned threads(unsigned jobs) { return jobs != 0 ? jobs : std::max(1U, std::thread::hardware_concurrency()); }

/// How far a campaign is, in one line that is written over itself: not by std::cerr, where control characters are
/// escaped.
class ProgressLine {
 public:
  void show(std::uint64_t cases, std::uint64_t cycles) const {
    if (shown_) fmt::print(stderr, "\r{} cases, {:.1f} M cycles", cases, static_cast<double>(cycles) / 1e6);
  }
  void clear() const {
    if (shown_) fmt::print(stderr, "\r{:60}\r", "");
  }

 private:
  bool shown_ = isatty(STDERR_FILENO) != 0;
};

int shrink_and_replay(const RtlRandomArguments& arguments, const cosim::CampaignResult& result, tb::OutputFile& file) {
  std::cout << fmt::format("case {} differs: {}\nshrinking it ...\n", result.cases, result.difference->what)
            << std::flush;
  const cosim::Stimulus shrunk =
      cosim::shrink(cosim::random_stimulus(result.failed_seed), maker(arguments), kShrinkRuns);
  const std::string text = cosim::to_text(shrunk);
  file.write(text);
  file.commit();
  const std::string fault = arguments.fault == 0 ? "" : fmt::format(" --fault {}", arguments.fault);
  std::cout << fmt::format("{} actions, to be seen again with\n  dsdpv1-sim rtl-random{} --seed {} --replay {}\n",
                           shrunk.size(), fault, arguments.seed, arguments.stimulus);
  // What the file says, not the file: a FIFO cannot be read here.
  return replay(arguments, cosim::parse_stimulus(text, arguments.stimulus), arguments.stimulus);
}

std::vector<NamedFile> with_files_of(const std::string& folder, std::vector<NamedFile> inputs) {
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    inputs.push_back({"a file of --directed", entry.path()});
  return inputs;
}

}  // namespace

int rtl_random(const RtlRandomArguments& arguments) {
  leave_nothing_on_signals();
  tb::check_wave_name(arguments.difference);
  check_outputs(
      "dsdpv1-sim rtl-random", {{"--replay", arguments.replay}},
      {{"--stimulus", arguments.replay.empty() ? arguments.stimulus : ""}, {"--difference", arguments.difference}});
  if (!arguments.replay.empty()) return replay(arguments, read_stimulus(arguments.replay), arguments.replay);
  tb::OutputFile stimulus(arguments.stimulus);  // before hours of random cases, not after them
  const auto begin = std::chrono::steady_clock::now();
  const ProgressLine line;
  const cosim::CampaignResult result =
      cosim::run_campaign({arguments.seed, arguments.cycles, threads(arguments.jobs)}, maker(arguments),
                          [&line](std::uint64_t cases, std::uint64_t cycles) { line.show(cases, cycles); });
  line.clear();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::cout << fmt::format("seed {}: {} cases, {} ({:.1f} M cycles/s)\n", arguments.seed, result.cases,
                           counts_text(result.counts), static_cast<double>(result.counts.cycles) / 1e6 / seconds)
            << result.coverage.text();
  return result.difference ? shrink_and_replay(arguments, result, stimulus) : kPassed;
}

int rtl_faults(const RtlFaultsArguments& arguments) {
  leave_nothing_on_signals();
  const auto given_or_own = [](const std::string& path, const char* own) { return path.empty() ? own : path; };
  const std::string list = given_or_own(arguments.list, DSDPV1_SOURCE_DIR "/rtl_ref/faults.txt");
  const std::string folder = given_or_own(arguments.directed, DSDPV1_SOURCE_DIR "/tests/cosim/stimuli");
  const std::vector<cosim::Fault> faults = cosim::read_faults(list);
  const std::vector<cosim::NamedStimulus> directed = cosim::read_stimuli(folder);
  check_outputs("dsdpv1-sim rtl-faults", with_files_of(folder, {{"--list", list}}), {{"--tsv", arguments.tsv}});
  std::optional<tb::OutputFile> tsv;
  if (!arguments.tsv.empty()) tsv.emplace(arguments.tsv);
  const cosim::Kill none = cosim::hunt({0, "none", "", "the build for the faults, with none active"}, directed,
                                       arguments.seed, arguments.cycles / 10);
  std::cout << cosim::heading();
  if (none.found) {
    std::cout << cosim::line_of(none) << "model and RTL differ without a fault; find that out first\n";
    return kFailed;
  }
  const std::vector<cosim::Kill> kills =
      cosim::hunt_all(faults, directed, {arguments.seed, arguments.cycles, threads(arguments.jobs)},
                      [](const cosim::Kill& kill) { std::cout << cosim::line_of(kill) << std::flush; });
  if (tsv) {
    tsv->write(cosim::to_tsv(kills));
    tsv->commit();
  }
  const auto found = std::count_if(kills.begin(), kills.end(), [](const cosim::Kill& kill) { return kill.found; });
  std::cout << fmt::format("{} of {} faults found\n", found, faults.size());
  return found == static_cast<std::ptrdiff_t>(faults.size()) ? kPassed : kFailed;
}

}  // namespace app

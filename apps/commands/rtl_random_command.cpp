// rtl-random: model and RTL in lockstep on random cases, or on a stimulus that is played again.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/command_line.hpp"
#include "apps/commands/rtl_commands.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/outputs.hpp"
#include "bus/printable.hpp"
#include "cosim/joined_wave.hpp"
#include "cosim/random/campaign.hpp"
#include "cosim/random/campaign_record.hpp"
#include "cosim/random/play_log.hpp"
#include "cosim/random/play_options.hpp"
#include "cosim/random/play_wave.hpp"
#include "cosim/random/stimulus_result.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "io/output/output_file.hpp"
#include "io/output/write_file.hpp"
#include "io/waves/wave_writer.hpp"
#include "kinds/dsdpv1/random/random_stimulus.hpp"
#include "lab/campaign/lock.hpp"

namespace dsdpv1::app {
namespace {

constexpr int kShrinkRuns = 600;
constexpr std::uint64_t kRound = 5'000'000;  // cycles of a campaign between two records: some seconds
constexpr const char* kChip = "chip";        // its scope in waves

cosim::Stimulus read_stimulus(const std::string& path, Part part) {
  return cosim::parse_stimulus(tb::read_file(path, tb::kStimulusFile), path, part);
}

std::string counts_text(const cosim::MatchCounts& counts) {
  return fmt::format("{} cycles, {} pin changes, {} DPRAM images the same", counts.cycles, counts.pin_changes,
                     counts.dpram_images);
}

/// The RTL that is played to, and how.
struct Bench {
  cosim::PlayOptions options;
  cosim::MakeTop make;
  cosim::MakeUserRtl make_own;  ///< null: it is the reference RTL
};

/// Makes the reference RTL for the parameters that it is asked for.
cosim::MakeTopFor reference_of(const RtlRandomArguments& arguments) {
  return [fault = arguments.fault, seed = static_cast<std::uint32_t>(arguments.seed)](
             const cosim::PlayOptions& options) { return cosim::reference_top(options, fault, seed); };
}

Bench bench_of(const RtlRandomArguments& arguments) {
  Bench bench;
  if (!arguments.own.rtl.empty() && dsdpv1::has_serial_ports(part_of(arguments.chip)))
    throw tb::InputError("--rtl: RTL of your own has the pins of table 1, allowed is without --chip dsdpv1_rsu");
  if (arguments.own.rtl.empty()) {
    bench.options = cosim::quick_options(part_of(arguments.chip));
    cosim::set_parameters(bench.options, arguments.set);
    bench.make = reference_of(arguments)(bench.options);
    return bench;
  }
  const OwnRtl own = build_own_rtl(arguments.own, arguments.command, !arguments.wave.empty());
  bench.options = cosim::own_rtl_options(own.map.tolerances);
  cosim::set_parameters(bench.options, arguments.set);
  bench.make_own = own.make;
  bench.make = [make = own.make] { return make(std::nullopt); };
  return bench;
}

/// What a stimulus that is played leaves. Opened before hours of random cases, not after them; without such a stimulus
/// there is none.
class StimulusOutputs {
 public:
  explicit StimulusOutputs(const RtlRandomArguments& arguments) : arguments_(arguments) {
    if (!arguments.log.empty()) log_.emplace(arguments.log);
    if (!arguments.result.empty()) result_.emplace(arguments.result);
    if (!arguments.wave.empty() && !tb::find_place(arguments.wave).direct) const tb::OutputFile probe(arguments.wave);
  }

  cosim::PlayResult play(const cosim::Stimulus& stimulus, const Bench& bench) {
    cosim::PlayOptions options = bench.options;
    options.wave = arguments_.difference;
    if (log_) options.listeners.push_back(&*log_);
    if (arguments_.wave.empty()) return cosim::play(stimulus, bench.make, options);
    cosim::JoinedWave wave(arguments_.wave, arguments_.own.build);
    cosim::PlayWave model(wave.model(), kChip, cosim::chip_kind(options.config.part));
    model.listen(options);
    const cosim::RtlTrace trace = wave.trace(kChip);
    const cosim::MakeTop traced = [&] { return bench.make_own(trace); };
    cosim::PlayResult result = cosim::play(stimulus, traced, options);
    wave.finish(result.difference);
    if (arguments_.wave_save) write_save_files(arguments_.wave, cosim::chip_kind(options.config.part));
    return result;
  }
  void finish(const cosim::StimulusResult& result) {
    if (!result_) return;
    result_->write(cosim::result_json(result));
    result_->commit();
  }

 private:
  const RtlRandomArguments& arguments_;
  std::optional<cosim::PlayLog> log_;
  std::optional<tb::OutputFile> result_;
};

/// Makes RTL for a case's own parameters, where nothing says which they are; empty: they are those of all cases.
cosim::MakeTopFor make_for(const RtlRandomArguments& arguments) {
  return arguments.own.rtl.empty() && arguments.set.empty() ? reference_of(arguments) : cosim::MakeTopFor();
}

/// From here on `arguments` and `bench` have the parameters of the case that differs.
void take_case(const cosim::CampaignResult& campaign, RtlRandomArguments& arguments, Bench& bench) {
  for (std::string& each : cosim::settings_between(bench.options.config, campaign.failed_config))
    arguments.set.push_back(std::move(each));
  bench.options.config = campaign.failed_config;
  if (arguments.own.rtl.empty()) bench.make = reference_of(arguments)(bench.options);
}

/// The waves that were written.
std::string files_text(const RtlRandomArguments& arguments, bool differs) {
  std::string text;
  if (differs) text += fmt::format("wave              {}\n", arguments.difference);
  if (!arguments.wave.empty()) text += fmt::format("with the inside   {}\n", arguments.wave);
  return text;
}

/// Plays it, says what came of it and notes that in `result`.
int play_stimulus(const RtlRandomArguments& arguments, const cosim::Stimulus& stimulus, const std::string& path,
                  const Bench& bench, StimulusOutputs& outputs, cosim::StimulusResult& result) {
  const cosim::PlayResult played = outputs.play(stimulus, bench);
  std::cout << bus::printable(path) << ": " << counts_text(played.counts) << '\n' << played.coverage.text();
  if (played.difference) std::cout << cosim::describe(*played.difference);
  std::cout << files_text(arguments, played.difference.has_value());
  result.difference = played.difference;
  if (!arguments.replay.empty()) {
    result.counts = played.counts;
    result.coverage = played.coverage;
  }
  return played.difference ? kFailed : kPassed;
}

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

/// As a word of a shell.
std::string word(const std::string& text) {
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string quoted;
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + quoted + "'";
}

/// The command that plays the case again.
std::string command_text(const RtlRandomArguments& arguments) {
  std::string text = arguments.command;
  const auto add = [&text](const char* option, const std::string& value) {
    if (!value.empty()) text += fmt::format(" {} {}", option, word(value));
  };
  const bool own = !arguments.own.rtl.empty();
  add("--chip", arguments.chip == RtlRandomArguments().chip ? "" : arguments.chip);
  add("--rtl", arguments.own.rtl);
  add("--top", arguments.own.top);
  add("--pins", arguments.own.pins);
  add("--build", own && arguments.own.build != OwnRtlArguments().build ? arguments.own.build : "");
  for (const std::string& each : arguments.set) add("--set", each);
  add("--fault", arguments.fault == 0 ? "" : std::to_string(arguments.fault));
  return text + fmt::format(" --seed {} --replay {}", arguments.seed, word(arguments.stimulus));
}

int shrink_and_play(RtlRandomArguments arguments, const cosim::CampaignResult& campaign, tb::OutputFile& file,
                    Bench bench, StimulusOutputs& outputs, cosim::StimulusResult& result) {
  const HostMode mode = mode_of(bench.options.config.part, arguments.mode);
  take_case(campaign, arguments, bench);
  std::cout << fmt::format("case {} differs: {}\nshrinking it ...\n", campaign.cases, campaign.difference->what)
            << std::flush;
  const cosim::Stimulus shrunk = cosim::shrink(cosim::random_stimulus(campaign.failed_seed, mode, bench.options.config),
                                               bench.make, kShrinkRuns, bench.options);
  const std::string text = cosim::to_text(shrunk);
  file.write(text);
  file.commit();
  result.case_seed = campaign.failed_seed;
  result.stimulus = arguments.stimulus;
  result.actions = shrunk.size();
  std::cout << fmt::format("{} actions, to be seen again with\n  {}\n", shrunk.size(), command_text(arguments));
  // What the file says, not the file: a FIFO cannot be read here.
  return play_stimulus(arguments, cosim::parse_stimulus(text, arguments.stimulus, bench.options.config.part),
                       arguments.stimulus, bench, outputs, result);
}

cosim::CampaignOptions options_of(const RtlRandomArguments& arguments, const Bench& bench) {
  cosim::CampaignOptions options;
  options.seed = arguments.seed;
  options.cycles = arguments.cycles;
  options.jobs = threads_of(arguments.jobs);
  options.play = bench.options;
  options.mode = mode_of(bench.options.config.part, arguments.mode);
  options.make_for = make_for(arguments);
  options.counts_situations = true;
  return options;
}

int random_cases(const RtlRandomArguments& arguments, const Bench& bench, StimulusOutputs& outputs,
                 cosim::StimulusResult& result) {
  tb::OutputFile stimulus(arguments.stimulus);
  const cosim::CampaignOptions options = options_of(arguments, bench);
  const cosim::HostSide side = {options.play.config.part, options.mode};
  const auto begin = std::chrono::steady_clock::now();
  const ProgressLine line;
  const cosim::CampaignResult campaign = cosim::run_campaign(
      options, bench.make, [&line](std::uint64_t cases, std::uint64_t cycles) { line.show(cases, cycles); });
  line.clear();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::cout << fmt::format("seed {}: {} cases, {} ({:.1f} M cycles/s)\n", arguments.seed, campaign.cases,
                           counts_text(campaign.counts), static_cast<double>(campaign.counts.cycles) / 1e6 / seconds)
            << campaign.coverage.text() << cosim::text(campaign.situations, side);
  if (!arguments.tsv.empty()) tb::write_file(arguments.tsv, cosim::table(campaign.situations, side));
  result.cases = campaign.cases;
  result.counts = campaign.counts;
  result.coverage = campaign.coverage;
  result.situations = campaign.situations;
  result.side = side;
  if (!campaign.difference) return kPassed;
  return shrink_and_play(arguments, campaign, stimulus, bench, outputs, result);
}

// --- a campaign at all ports ----------------------------------------------------------------------------------------

std::string record_text(const cosim::CampaignRecord& record) {
  return fmt::format("seed {}: {} cases, {} cycles", record.seed, record.cases(), record.cycles());
}

/// The next cases at one port, which are kept unless one differs.
int play_round(const RtlRandomArguments& all, cosim::CampaignRecord& record, cosim::PortRecord& port) {
  RtlRandomArguments arguments = all;
  arguments.chip = port.chip();
  arguments.mode = port.mode();
  arguments.cycles = kRound;
  const Bench bench = bench_of(arguments);
  tb::OutputFile stimulus(arguments.stimulus);
  cosim::CampaignOptions options = options_of(arguments, bench);
  options.first_case = port.cases;
  const cosim::CampaignResult campaign = cosim::run_campaign(options, bench.make);
  if (campaign.difference) {
    StimulusOutputs outputs(arguments);
    cosim::StimulusResult result;
    std::cout << port.name() << ", from case " << port.cases << " on: ";
    return shrink_and_play(arguments, campaign, stimulus, bench, outputs, result);
  }
  cosim::CampaignRecord::add(port, campaign);
  cosim::write_record(arguments.state, record);
  std::cout << record_text(record) << '\n' << std::flush;
  return kPassed;
}

/// Goes on where the folder's record ends, until so many cycles are compared in all.
int campaign_of_all(const RtlRandomArguments& arguments) {
  const tb::campaign::Lock lock(arguments.state, "rtl-random");
  cosim::CampaignRecord record = cosim::read_record(arguments.state, arguments.seed);
  while (cosim::PortRecord* port = record.behind(arguments.cycles))
    if (const int status = play_round(arguments, record, *port); status != kPassed) return status;
  for (const cosim::PortRecord& port : record.ports)
    std::cout << fmt::format("\n{}: {} cases, {}\n", port.name(), port.cases, counts_text(port.counts))
              << port.coverage.text() << cosim::text(port.situations, port.side);
  std::cout << '\n' << record_text(record) << ", no difference\n";
  if (!arguments.tsv.empty()) tb::write_file(arguments.tsv, cosim::table(record));
  return kPassed;
}

void check_files(const RtlRandomArguments& arguments) {
  tb::check_wave_name(arguments.difference);
  if (!arguments.wave.empty()) tb::check_wave_name(arguments.wave);
  std::vector<NamedFile> outputs = wave_files(arguments.command, arguments.wave, arguments.wave_save);
  outputs.push_back({"--stimulus", arguments.replay.empty() ? arguments.stimulus : ""});
  outputs.push_back({"--difference", arguments.difference});
  outputs.push_back({"--log", arguments.log});
  outputs.push_back({"--result", arguments.result});
  outputs.push_back({"--tsv", arguments.tsv});
  check_outputs(arguments.command, {{"--replay", arguments.replay}, {"--pins", arguments.own.pins}}, outputs);
}

}  // namespace

Part part_of(const std::string& chip) {
  check_word("--chip", chip, {"dsdpv1", "dsdpv1_r", "dsdpv1_rsu"});
  return *dsdpv1::part_called(chip);
}

HostMode mode_of(Part part, const std::string& mode) {
  check_word("--mode", mode, {"parallel", "spi", "uart"});
  if (!dsdpv1::has_serial_ports(part) && mode != "parallel")
    throw tb::InputError("--mode " + mode +
                         ": only the dsdpv1_rsu has that port, allowed is --chip dsdpv1_rsu with it");
  if (mode == "spi") return HostMode::kSpi;
  return mode == "uart" ? HostMode::kUart : HostMode::kParallel;
}

unsigned threads_of(unsigned jobs) { return jobs != 0 ? jobs : std::max(1U, std::thread::hardware_concurrency()); }

int rtl_random(const RtlRandomArguments& arguments) {
  leave_nothing_on_signals();
  check_files(arguments);
  mode_of(part_of(arguments.chip), arguments.mode);
  if (arguments.campaign) return campaign_of_all(arguments);
  cosim::Stimulus stimulus;
  if (!arguments.replay.empty()) stimulus = read_stimulus(arguments.replay, part_of(arguments.chip));
  const Bench bench = bench_of(arguments);
  StimulusOutputs outputs(arguments);
  cosim::StimulusResult result;
  result.rtl = arguments.own.rtl;
  result.fault = arguments.fault;
  result.seed = arguments.seed;
  result.replayed = arguments.replay;
  const int status = arguments.replay.empty()
                         ? random_cases(arguments, bench, outputs, result)
                         : play_stimulus(arguments, stimulus, arguments.replay, bench, outputs, result);
  outputs.finish(result);
  return status;
}

}  // namespace dsdpv1::app

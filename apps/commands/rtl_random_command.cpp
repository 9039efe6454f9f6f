// rtl-random: model and RTL in lockstep on random cases, or on a stimulus that is played again.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "apps/commands/command.hpp"
#include "apps/commands/rtl_random.hpp"
#include "apps/data_folder.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/common.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/wave_options.hpp"
#include "bus/printable.hpp"
#include "cosim/joined_wave.hpp"
#include "cosim/random/campaign.hpp"
#include "cosim/random/campaign_record.hpp"
#include "cosim/random/play_log.hpp"
#include "cosim/random/play_options.hpp"
#include "cosim/random/play_wave.hpp"
#include "cosim/random/recorded_stimulus.hpp"
#include "cosim/random/stimulus_result.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "io/output/output_file.hpp"
#include "io/output/shell_word.hpp"
#include "io/output/write_file.hpp"
#include "io/waves/wave_writer.hpp"
#include "lab/campaign/lock.hpp"

namespace dsdpv1::app {
namespace {

constexpr int kShrinkRuns = 600;
constexpr std::uint64_t kRound = 5'000'000;  // cycles of a campaign between two records: some seconds
constexpr const char* kChip = "chip";        // its scope in waves
constexpr cosim::Tick kNoLimit = cosim::Tick{1} << 50;

/// With its parameters, which those of the command line change.
cosim::Stimulus read_stimulus(RtlRandomArguments& arguments) {
  const std::string text = tb::read_file(arguments.replay, tb::kStimulusFile);
  arguments.told = cosim::settings_in(text);
  return cosim::parse_stimulus(text, arguments.replay, arguments.chip.kind());
}

std::string counts_text(const cosim::MatchCounts& counts) {
  return fmt::format("{} cycles, {} pin changes, {} DPRAM images the same", counts.cycles, counts.pin_changes,
                     counts.dpram_images);
}

/// The RTL that is played to, and how.
struct Bench {
  cosim::PlayOptions options;
  cosim::MakeTop make;
  cosim::MakeUserRtl make_own;          ///< null: it is the reference RTL
  std::function<std::string()> counts;  ///< of OwnRtl
};

/// Makes the reference RTL for the parameters that it is asked for.
cosim::MakeTopFor reference_of(const RtlRandomArguments& arguments) {
  return [fault = arguments.fault, seed = static_cast<std::uint32_t>(arguments.seed)](
             const cosim::PlayOptions& options) { return cosim::reference_top(options, fault, seed); };
}

Bench bench_of(const RtlRandomArguments& arguments) {
  std::vector<std::string> set = arguments.told;
  set.insert(set.end(), arguments.set.begin(), arguments.set.end());
  Bench bench{play_options(arguments.chip, arguments.own, set, arguments.no_dpram), {}, {}, {}};
  if (!arguments.replay.empty()) bench.options.limit = kNoLimit;  // its last action is the end
  if (arguments.own.rtl.empty()) {
    bench.make = reference_of(arguments)(bench.options);
    return bench;
  }
  const OwnRtl own = build_own_rtl(arguments.own, arguments.command, *bench.options.kind, *bench.options.chip,
                                   !arguments.wave.empty(), arguments.fault);
  bench.make_own = own.make;
  bench.counts = own.counts;
  bench.make = [make = own.make] { return make(std::nullopt); };
  return bench;
}

/// The output files of a played stimulus, opened before hours of random cases. There are none without a stimulus.
class StimulusOutputs {
 public:
  explicit StimulusOutputs(const RtlRandomArguments& arguments) : arguments_(arguments), result_(arguments.result) {
    if (!arguments.log.empty()) log_.emplace(arguments.log, arguments.chip.kind());
    if (!arguments.wave.empty() && !tb::find_place(arguments.wave).direct) const tb::OutputFile probe(arguments.wave);
  }

  cosim::PlayResult play(const cosim::Stimulus& stimulus, const Bench& bench) {
    cosim::PlayOptions options = bench.options;
    options.wave = arguments_.difference;
    if (log_) options.listeners.push_back(&*log_);
    if (arguments_.wave.empty()) return cosim::play(stimulus, bench.make, options);
    cosim::JoinedWave wave(arguments_.wave, arguments_.own.build);
    cosim::PlayWave model(wave.model(), kChip, *options.kind);
    model.listen(options);
    const cosim::RtlTrace trace = wave.trace(kChip);
    const cosim::MakeTop traced = [&] { return bench.make_own(trace); };
    cosim::PlayResult result = cosim::play(stimulus, traced, options);
    wave.finish(result.difference);
    if (arguments_.wave_save) write_save_files(arguments_.wave, {options.kind});
    return result;
  }
  void finish(const cosim::StimulusResult& result) {
    result_.write([&] { return cosim::result_json(result); });
  }

 private:
  const RtlRandomArguments& arguments_;
  std::optional<cosim::PlayLog> log_;
  WantedFile result_;
};

/// Makes RTL for a case's own parameters, where nothing says which they are; empty: they are those of all cases.
cosim::MakeTopFor make_for(const RtlRandomArguments& arguments) {
  return arguments.own.rtl.empty() && arguments.set.empty() ? reference_of(arguments) : cosim::MakeTopFor();
}

/// From here on `arguments` and `bench` have the parameters of the case that differs.
void take_case(const cosim::CampaignResult& campaign, RtlRandomArguments& arguments, Bench& bench) {
  arguments.set.insert(arguments.set.end(), campaign.failed_settings.begin(), campaign.failed_settings.end());
  cosim::set_parameters(bench.options, campaign.failed_settings);
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
  std::cout << bus::printable(path) << ": " << counts_text(played.counts) << '\n'
            << played.coverage.text(bench.options.kind->reasons());
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

/// The command that plays the case again.
std::string command_text(const RtlRandomArguments& arguments) {
  std::string text = arguments.command;
  const auto add = [&text](const char* option, const std::string& value) {
    if (!value.empty()) text += fmt::format(" {} {}", option, tb::shell_word(value));
  };
  const bool own = !arguments.own.rtl.empty();
  add("--chip", arguments.chip.chip == RtlChip().chip ? "" : arguments.chip.chip);
  add("--rtl", arguments.own.rtl);
  add("--top", arguments.own.top);
  add("--pins", arguments.own.pins);
  add("--build", own && arguments.own.build != OwnRtlArguments().build ? arguments.own.build : "");
  for (const std::string& each : arguments.set) add("--set", each);
  if (arguments.no_dpram) text += " --no-dpram";
  add("--fault", arguments.fault == 0 ? "" : std::to_string(arguments.fault));
  return text + fmt::format(" --seed {} --replay {}", arguments.seed, tb::shell_word(arguments.stimulus));
}

/// Shrinks a case that differs into the file of --stimulus, with the parameters that only the file says; returns its
/// text.
std::string shrink(const RtlRandomArguments& arguments, const cosim::Stimulus& stimulus, const Bench& bench,
                   tb::OutputFile& file, cosim::StimulusResult& result) {
  std::cout << "shrinking it ...\n" << std::flush;
  const cosim::Stimulus shrunk = cosim::shrink(stimulus, bench.make, kShrinkRuns, bench.options);
  const std::string text = cosim::to_text(shrunk, *bench.options.kind, arguments.told);
  file.write(text);
  file.commit();
  result.stimulus = arguments.stimulus;
  result.actions = shrunk.size();
  std::cout << fmt::format("{} actions, to be seen again with\n  {}\n", shrunk.size(), command_text(arguments));
  return text;
}

int shrink_and_play(RtlRandomArguments arguments, const cosim::CampaignResult& campaign, tb::OutputFile& file,
                    Bench bench, StimulusOutputs& outputs, cosim::StimulusResult& result) {
  take_case(campaign, arguments, bench);
  std::cout << fmt::format("case {} differs: {}\n", campaign.cases, campaign.difference->what);
  result.case_seed = campaign.failed_seed;
  const cosim::Stimulus stimulus = cosim::random_case(campaign.failed_seed, bench.options);
  const std::string text = shrink(arguments, stimulus, bench, file, result);
  // The content, not the file: a FIFO cannot be read here.
  return play_stimulus(arguments, cosim::parse_stimulus(text, arguments.stimulus, *bench.options.kind),
                       arguments.stimulus, bench, outputs, result);
}

cosim::CampaignOptions options_of(const RtlRandomArguments& arguments, const Bench& bench) {
  cosim::CampaignOptions options;
  options.seed = arguments.seed;
  options.cycles = arguments.cycles;
  options.jobs = at_a_time(arguments.jobs);
  options.play = bench.options;
  options.make_for = make_for(arguments);
  options.counts_situations = true;
  return options;
}

/// The stimulus of --replay; when it differs, it is shrunk if that is wanted.
int replay(const RtlRandomArguments& arguments, const cosim::Stimulus& stimulus, const Bench& bench,
           StimulusOutputs& outputs, cosim::StimulusResult& result) {
  std::optional<tb::OutputFile> file;
  if (arguments.shrink) file.emplace(arguments.stimulus);
  const int status = play_stimulus(arguments, stimulus, arguments.replay, bench, outputs, result);
  if (status == kFailed && file) shrink(arguments, stimulus, bench, *file, result);
  return status;
}

int random_cases(const RtlRandomArguments& arguments, const Bench& bench, StimulusOutputs& outputs,
                 cosim::StimulusResult& result) {
  tb::OutputFile stimulus(arguments.stimulus);
  const cosim::CampaignOptions options = options_of(arguments, bench);
  const tb::ChipKind& kind = *options.play.kind;
  result.known = kind.random()->known_situations(*options.play.chip);
  const auto begin = std::chrono::steady_clock::now();
  const ProgressLine line;
  const cosim::CampaignResult campaign = cosim::run_campaign(
      options, bench.make, [&line](std::uint64_t cases, std::uint64_t cycles) { line.show(cases, cycles); });
  line.clear();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::cout << fmt::format("seed {}: {} cases, {} ({:.1f} M cycles/s)\n", arguments.seed, campaign.cases,
                           counts_text(campaign.counts), static_cast<double>(campaign.counts.cycles) / 1e6 / seconds)
            << campaign.coverage.text(kind.reasons()) << cosim::text(campaign.situations, result.known);
  if (!arguments.tsv.empty()) tb::write_file(arguments.tsv, cosim::table(campaign.situations, result.known));
  result.cases = campaign.cases;
  result.counts = campaign.counts;
  result.coverage = campaign.coverage;
  result.situations = campaign.situations;
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
  arguments.chip = {port.kind->name(), port.port->word};
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

/// Resumes at the end of the folder's record, until so many cycles are compared in total.
int campaign_of_all(const RtlRandomArguments& arguments) {
  const tb::campaign::Lock lock(arguments.state, "rtl-random");
  cosim::CampaignRecord record = cosim::read_record(arguments.state, arguments.seed);
  while (cosim::PortRecord* port = record.behind(arguments.cycles))
    if (const int status = play_round(arguments, record, *port); status != kPassed) return status;
  for (const cosim::PortRecord& port : record.ports)
    std::cout << fmt::format("\n{}: {} cases, {}\n", port.name(), port.cases, counts_text(port.counts))
              << port.coverage.text(port.kind->reasons()) << cosim::text(port.situations, port.known());
  std::cout << '\n' << record_text(record) << ", no difference\n";
  if (!arguments.tsv.empty()) tb::write_file(arguments.tsv, cosim::table(record));
  return kPassed;
}

void check_files(const RtlRandomArguments& arguments) {
  tb::check_wave_name(arguments.difference);
  if (!arguments.wave.empty()) tb::check_wave_name(arguments.wave);
  std::vector<NamedFile> outputs = wave_files(arguments.command, arguments.wave, arguments.wave_save);
  outputs.insert(outputs.end(), {{"--stimulus", arguments.replay.empty() || arguments.shrink ? arguments.stimulus : ""},
                                 {"--difference", arguments.difference},
                                 {"--log", arguments.log},
                                 {"--result", arguments.result},
                                 {"--tsv", arguments.tsv},
                                 {"--coverage", arguments.own.coverage}});
  std::vector<NamedFile> inputs = own_inputs(arguments.own);
  inputs.push_back({"--replay", arguments.replay});
  check_outputs(arguments.command, inputs, outputs);
}

}  // namespace

int rtl_random(RtlRandomArguments arguments) {
  leave_nothing_on_signals();
  check_files(arguments);
  arguments.chip.port();
  if (arguments.campaign) return campaign_of_all(arguments);
  cosim::Stimulus stimulus;
  if (!arguments.replay.empty()) stimulus = read_stimulus(arguments);
  CoverageFile coverage(arguments.own);
  const Bench bench = bench_of(arguments);
  if (!arguments.own.rtl.empty())
    std::cout << fmt::format("{} as a {}\n", bus::printable(arguments.own.top), bench.options.kind->title());
  StimulusOutputs outputs(arguments);
  cosim::StimulusResult result;
  result.kind = &arguments.chip.kind();
  result.mode = arguments.chip.mode;
  result.documents = ruling_documents(result.kind->name());
  result.rtl = arguments.own.rtl;
  result.fault = arguments.fault;
  result.seed = arguments.seed;
  result.replayed = arguments.replay;
  const int status = arguments.replay.empty() ? random_cases(arguments, bench, outputs, result)
                                              : replay(arguments, stimulus, bench, outputs, result);
  outputs.finish(result);
  coverage.add(bench.counts);
  coverage.write();
  return status;
}

void write_stimulus(const RtlRandomArguments& given, const ScenarioInputs& inputs, const OwnRtl& own) {
  RtlRandomArguments arguments = given;
  arguments.told = inputs.set;
  Bench bench{cosim::usual_options(arguments.chip.kind()), [&own] { return own.make(std::nullopt); }, {}, {}};
  bench.options.chip = inputs.chip;
  bench.options.limit = kNoLimit;
  bench.options.lockstep.tolerances = own.map.tolerances;
  bench.options.reads_back = true;  // as where it is played again, unless the stimulus says that it is alone
  const cosim::Stimulus stimulus = cosim::recorded_stimulus(inputs.changes, inputs.difference.at, *bench.options.kind);
  const cosim::PlayResult played = cosim::play(stimulus, bench.make, bench.options);
  if (inputs.changes.empty() || !played.difference || played.difference->at != inputs.difference.at ||
      played.difference->what != inputs.difference.what) {
    std::cout << "as a stimulus     the chip's inputs alone do not show it: the scenario has to be run\n";
    return;
  }
  tb::OutputFile file(arguments.stimulus);
  cosim::StimulusResult result;
  shrink(arguments, stimulus, bench, file, result);
}

namespace {

class RtlRandom : public Command {
 public:
  RtlRandom() : Command("rtl-random", "Random stimulus for model and RTL in lockstep, the reference RTL or your own") {}

  void options(CLI::App& app) override {
    add_what_is_played(app);
    add_what_is_written(app);
    app.footer(
        "\n--wave and --log are written of the case that differs, and of a stimulus that --replay plays.\n"
        "\nExamples:\n  dsdpv1-sim rtl-random --cycles 100000000 --seed 7\n"
        "  dsdpv1-sim rtl-random --chip dsdpv1_rsu --mode spi --cycles 100000000\n"
        "  dsdpv1-sim rtl-random --campaign --cycles 1000000000 --state nightly --tsv situations.tsv\n"
        "  dsdpv1-sim rtl-random --replay lockstep.stimulus --difference both.fst --log case.log\n"
        "  dsdpv1-sim rtl-random --rtl my_chip --top chip --pins pins.yaml --set chip.search_window_ms=1 --result "
        "r.json\n"
        "  dsdpv1-sim rtl-random --rtl my_chip --top chip --replay lockstep.stimulus --wave inside.fst\n"
        "\nExit codes: 0 no difference, 1 a difference, 2 wrong input, 130 interrupted.\n");
  }

  int carry_out() override { return rtl_random(given_); }

 private:
  void add_what_is_played(CLI::App& app) {
    add_chip_options(app, given_.chip);
    app.add_option("--cycles", given_.cycles, "Number of cycles to compare")
        ->check(CLI::Range(std::uint64_t{1}, kMostCycles))
        ->capture_default_str();
    app.add_option("--seed", given_.seed, "Seed; equal seeds give equal cases")->capture_default_str();
    app.add_option("--jobs", given_.jobs, "Threads (default: one per processor)")->check(CLI::Range(1, 256));
    CLI::Option* replay = app.add_option("--replay", given_.replay, "This stimulus file instead of random cases");
    app.add_flag("--shrink", given_.shrink, "Shrink it into the file of --stimulus if it differs")->needs(replay);
    add_own_rtl_options(app, given_.own, false);
    add_coverage_option(app, given_.own);
    add_fault_option(app, given_.fault);
    CLI::Option* no_dpram = add_no_dpram_option(app, given_.no_dpram)->excludes("--rtl");
    campaign_ = app.add_flag("--campaign", given_.campaign,
                             "Use the DSDPV1 and each port of the DSDPV1-RSU in turn; resume from --state")
                    ->excludes(no_dpram);
    for (const char* each : {"--chip", "--mode", "--replay", "--rtl"}) campaign_->excludes(each);
    app.add_option("--state", given_.state, "Folder that keeps a campaign's progress")
        ->capture_default_str()
        ->needs(campaign_);
    app.add_option(
           "--set", given_.set,
           "chip.KEY=VALUE, once for each: a parameter of the model, as in a scenario (default: short times; those "
           "of scenarios for RTL whose map does not take them)")
        ->allow_extra_args(false);
  }

  void add_what_is_written(CLI::App& app) {
    app.add_option("--stimulus", given_.stimulus, "File for a case that differs, shrunk")->capture_default_str();
    app.add_option("--difference", given_.difference, "Wave of both sides' pins for it")->capture_default_str();
    CLI::Option* wave =
        app.add_option("--wave", given_.wave,
                       "Wave of it with internal signals of your RTL and the model: FILE.vcd or FILE.fst")
            ->needs("--rtl");
    add_wave_save_option(app, given_.wave_save, wave);
    app.add_option("--log", given_.log,
                   "Log of it: every change of every pin, events, telegrams; FILE.jsonl: for programs");
    app.add_option("--result", given_.result, "Write the result as JSON, also without a difference (docs/cosim.md)")
        ->excludes(campaign_);
    app.add_option("--tsv", given_.tsv,
                   "Write the counts of states, services, refusals and situations at the host port, also those that "
                   "did not occur")
        ->excludes("--replay");
  }

  RtlRandomArguments given_;
  CLI::Option* campaign_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_rtl_random() { return std::make_unique<RtlRandom>(); }

}  // namespace dsdpv1::app

// regress: many runs in child processes or on a cluster, then the tables and the page.
#include <fmt/format.h>

#include <iostream>
#include <map>
#include <set>

#include "apps/commands/command.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/campaign.hpp"
#include "apps/options/common.hpp"
#include "apps/options/scenario_files.hpp"
#include "apps/options/words.hpp"
#include "apps/terminal.hpp"
#include "io/input/input_error.hpp"
#include "io/output/write_file.hpp"
#include "lab/campaign/contents.hpp"
#include "lab/campaign/fingerprint.hpp"
#include "lab/campaign/jobs.hpp"
#include "lab/regress/folder.hpp"
#include "lab/regress/page.hpp"
#include "lab/regress/tables.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/report/text_table.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {
namespace {

using tb::campaign::Contents;
using tb::campaign::Ended;
using tb::campaign::Json;
using tb::regress::Description;
using tb::regress::Folder;
using tb::regress::Outcome;
using tb::regress::Plan;
using tb::regress::Report;
using tb::regress::Run;
using tb::regress::Verdict;

/// Words of a list, each once.
void check_words(const std::string& option, const std::vector<std::string>& given,
                 const std::vector<std::string>& allowed) {
  std::set<std::string> seen;
  for (const std::string& word : given) {
    check_word("dsdpv1-sim regress: " + option, word, allowed);
    if (!seen.insert(word).second)
      throw tb::InputError(fmt::format("dsdpv1-sim regress: {} has {} twice, expected once", option, word));
  }
}

bool pins_only(const Run& run) {
  try {
    const auto scenario = tb::scenario::load(run.scenario, tb::scenario::parse_settings(run.settings));
    return scenario.kind->needs_pins(scenario);
  } catch (const tb::InputError&) {  // the run says what is wrong
    return false;
  }
}

constexpr int kNotStarted = 127;

/// A scenario that cannot be read is refused by its run, which says why.
std::vector<std::string> files_of(const Run& run) {
  std::vector<std::string> files = {run.scenario};
  try {
    const std::vector<std::string> named =
        tb::scenario::files(run.scenario, tb::scenario::parse_settings(run.settings));
    files.insert(files.end(), named.begin(), named.end());
  } catch (const tb::InputError&) {
  }
  return files;
}

std::string key_of(const Description& description, const Run& run, const Json& contents, const std::string& program) {
  const Json all = {{"program", program},
                    {"words", run.words()},
                    {"checks", description.checks},
                    {"wave", description.wave},
                    {"keep", static_cast<int>(description.keep)},
                    {"report", description.report},
                    {"contents", contents}};
  return tb::campaign::fingerprint(tb::campaign::text_of(all));
}

/// Exit codes of a run that say nothing about it.
bool says_nothing(int exit) { return exit == kInterrupted || exit == kNotStarted; }

/// Exit code 2 is not always the scenario's: a full disk has it too. Then the line is about a file in the run's place.
bool could_not_write(const Ended& ended, const std::string& place) {
  return ended.exit == kWrongInput && ended.output.rfind(place + "/", 0) == 0;
}

/// The files that each run reads, and what it depends on.
class RegressInputs {
 public:
  /// Reads all of them. Throws InputError for a file that can be read only once.
  RegressInputs(const Description& description, const std::string& program) : contents_(tb::regress::kind()) {
    for (const Run& run : description.plan.runs) {
      files_.push_back(files_of(run));
      Json contents;
      for (const std::string& file : files_.back()) {
        contents_.add(file);
        contents[file] = contents_.all().at(file);
      }
      keys_.push_back(key_of(description, run, contents, program));
    }
  }
  const Contents& contents() const { return contents_; }
  /// A fingerprint of program, files and words of a run.
  const std::string& key(std::size_t run) const { return keys_[run]; }
  Contents::Times look(std::size_t run) const { return contents_.look(files_[run]); }

 private:
  Contents contents_;
  std::vector<std::vector<std::string>> files_;
  std::vector<std::string> keys_;
};

/// The runs of a regression as runs of this program.
class RegressJobs : public tb::campaign::Jobs {
 public:
  /// `anyhow`: what is known of a run counts whatever it depended on (--failed).
  RegressJobs(const Plan& plan, const RegressInputs& inputs, const Folder& folder, bool anyhow)
      : plan_(plan), inputs_(inputs), folder_(folder), anyhow_(anyhow), outcomes_(plan.runs.size()) {}

  std::size_t size() const override { return outcomes_.size(); }
  bool finished(std::size_t job) const override { return outcomes_[job].has_value(); }
  bool look(std::size_t job) override {
    outcomes_[job] = folder_.finished(plan_.runs[job], anyhow_ ? "" : inputs_.key(job));
    return finished(job);
  }
  std::vector<std::string> begin(std::size_t job) override {
    read_[job] = inputs_.look(job);
    return folder_.words(plan_.runs[job]);
  }
  std::string end(const Ended& ended) override {
    const auto read = read_.extract(ended.job);
    if (says_nothing(ended.exit) || could_not_write(ended, folder_.place(plan_.runs[ended.job]))) return fate(ended);
    if (inputs_.look(ended.job) != read.mapped())
      return "one of its files was written while it ran";  // and has its old content again
    outcomes_[ended.job] = folder_.finish(plan_.runs[ended.job], inputs_.key(ended.job), ended);
    return "";
  }
  void forget(std::size_t job) override { folder_.forget(plan_.runs[job]); }
  std::string name(std::size_t job) const override { return plan_.runs[job].name(); }

  /// The results of all runs, when all are finished.
  std::vector<Outcome> outcomes() const {
    std::vector<Outcome> all;
    for (const std::optional<Outcome>& outcome : outcomes_) all.push_back(*outcome);
    return all;
  }

 private:
  const Plan& plan_;
  const RegressInputs& inputs_;
  const Folder& folder_;
  bool anyhow_;
  std::vector<std::optional<Outcome>> outcomes_;
  std::map<std::size_t, Contents::Times> read_;  ///< of the runs under way: their files when they began
};

/// True for a known result to repeat: with --failed all that did not pass; otherwise those that may be the machine's
/// fault.
bool is_stale(const Outcome& outcome, bool failed) {
  if (failed) return !outcome.passed();
  return outcome.verdict == Verdict::kCrashed || outcome.verdict == Verdict::kHung;
}

void remove_stale(const Folder& folder, const Description& description, bool failed) {
  for (const Run& run : description.plan.runs) {
    const auto known = folder.finished(run, "");
    if (known && is_stale(*known, failed)) folder.remove(run);
  }
}

int status_of(const Report& report) {
  const auto any = [&report](const auto& is) {
    return std::any_of(report.outcomes.begin(), report.outcomes.end(), is);
  };
  const auto judged_nothing = [](const Outcome& each) { return each.verdict == tb::regress::Verdict::kNothingJudged; };
  if (any([&](const Outcome& each) { return !each.passed() && !judged_nothing(each); })) return kFailed;
  return any(judged_nothing) ? kNothingJudged : kPassed;
}

class Regress : public Command {
 public:
  Regress()
      : Command("regress", "Run scenarios with all combinations of engines, views and settings, and judge each run") {}

  void options(CLI::App& app) override {
    const std::vector<CLI::Option*> of_plan = add_plan_options(app);
    CLI::Option* failed = app.add_flag("--failed", failed_, "Repeat the runs in --out that did not pass");
    for (CLI::Option* other : of_plan) failed->excludes(other);
    app.add_option("--time-limit", time_limit_, "Kill a run after so many seconds and count it as failed; 0: no limit")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    app.add_option("--junit", junit_, "Write the report for CI as JUnit's XML");
    app.add_flag("--json", json_, "Write the table as JSON");
    add_campaign_options(app, campaign_, "regression");
    app.footer(
        "\nExamples:\n"
        "  dsdpv1-sim regress\n"
        "  dsdpv1-sim regress scenarios my.yaml --engine step,skip,lockstep --view pins,tlm --junit report.xml\n"
        "  dsdpv1-sim regress my.yaml --set user_cpu.fsmc.datast=2..5 --set baud=12M,6M --wave fst --report\n"
        "  dsdpv1-sim regress --engine rtl --seed 1..8 --shard 2/5 --out part_2\n"
        "  dsdpv1-sim regress --failed\n"
        "The same command resumes an interrupted regression. docs/regress.md explains the results.\n"
        "\nExit codes: 0 all runs passed, 1 some did not, 2 wrong input, 3 none failed, but some judged nothing, 130 "
        "interrupted.\n");
  }

  int carry_out() override {
    leave_nothing_on_signals();
    campaign_.words = words;
    if (campaign_.out.empty()) campaign_.out = "regression";
    const Description description = failed_ ? tb::regress::last_description(campaign_.out) : new_description();
    const std::string program = tb::campaign::program_identity(DSDPV1_VERSION);
    const RegressInputs inputs(description, program);
    if (!campaign_.is_task()) check_files(inputs);
    WantedFile junit(campaign_.is_task() ? "" : junit_);
    catch_signals();
    const Folder folder(campaign_.out, description, campaign_.access());
    if (!campaign_.is_task()) remove_stale(folder, description, failed_);
    RegressJobs jobs(description.plan, inputs, folder, failed_);
    const std::string identity = tb::campaign::fingerprint(program + tb::campaign::text_of(json_of(description)) +
                                                           tb::campaign::text_of(inputs.contents().all()));
    std::optional<std::chrono::duration<double>> limit;
    if (time_limit_ > 0) limit.emplace(time_limit_);
    if (!carry_out_jobs(campaign_, tb::regress::kind(), jobs, folder.base(), identity, limit)) return kInterrupted;
    if (campaign_.is_task()) return kPassed;
    const Report report{description.plan, jobs.outcomes()};
    write_report(report, folder, junit);
    return status_of(report);
  }

 private:
  /// Adds the options that select what is run.
  std::vector<CLI::Option*> add_plan_options(CLI::App& app) {
    CLI::Option* scenarios = app.add_option("SCENARIO", request_.scenarios,
                                            "Scenarios, and folders of them (.yaml, .yml; default: ./scenarios)");
    CLI::Option* engine =
        app.add_option("--engine", request_.engines, "Engines of run, separated by commas (default: skip)")
            ->delimiter(',');
    CLI::Option* view =
        app.add_option("--view", request_.views, "Views of run, separated by commas (default: pins)")->delimiter(',');
    CLI::Option* seed =
        app.add_option("--seed", seeds_, "Seeds of runs with RTL, such as 1..4,7 (default: the usual one)");
    CLI::Option* set =
        app.add_option(
               "--set", set_,
               "PATH=VALUES, once for each key, lists and ranges as --param of sweep: user_cpu.fsmc.datast=2..5")
            ->allow_extra_args(false);
    CLI::Option* checks = app.add_option("--checks", description_.checks, "As for run");
    CLI::Option* shard = app.add_option("--shard", shard_, "2/5: the second fifth of the runs, always the same");
    CLI::Option* wave = app.add_option("--wave", description_.wave, "Write waves of each run: vcd, fst (default: none)")
                            ->type_name("WORD");
    CLI::Option* report = app.add_flag("--report", description_.report,
                                       "Write a page of charts and timing diagrams for each run (docs/report.md)");
    CLI::Option* keep = app.add_option(
        "--keep", keep_, "Keep log, result, wave and report of these runs: none, failed, all (default: failed)");
    return {scenarios, engine, view, seed, set, checks, shard, wave, report, keep};
  }

  Description new_description() {
    checks_mode("dsdpv1-sim regress", description_.checks);
    if (!description_.wave.empty()) check_word("dsdpv1-sim regress: --wave", description_.wave, {"vcd", "fst"});
    if (!keep_.empty()) check_word("dsdpv1-sim regress: --keep", keep_, tb::regress::keep_words());
    const tb::regress::Shard shard = shard_.empty() ? tb::regress::Shard() : tb::regress::parse_shard(shard_);
    description_.keep = tb::regress::keep_named(keep_).value_or(tb::regress::Keep::kFailed);
    take_request();
    description_.plan = plan_of(request_, shard);
    return description_;
  }

  void take_request() {
    for (std::string& each : request_.scenarios) each = scenario_file("dsdpv1-sim regress", each);
    if (request_.scenarios.empty()) request_.scenarios = {"scenarios"};
    check_words("--engine", request_.engines, {"step", "skip", "rtl", "lockstep"});
    check_words("--view", request_.views, {"pins", "tlm"});
    if (!seeds_.empty()) request_.seeds = tb::regress::parse_seeds(seeds_);
    for (const std::string& text : set_) request_.parameters.push_back(tb::sweep::parse_parameter(text, "--set"));
    request_.pins_only = pins_only;
  }

  void check_files(const RegressInputs& inputs) const {
    std::vector<NamedFile> read;
    for (const auto& file : inputs.contents().all().items()) read.push_back({"a file of a scenario", file.key()});
    std::vector<NamedFile> written = outputs_in(campaign_.out, tb::regress::kind());
    written.push_back({"--junit", junit_});
    check_outputs("dsdpv1-sim regress", read, written);
  }

  void write_report(const Report& report, const Folder& folder, WantedFile& junit) const {
    const std::string index = folder.base().file("index.html");
    tb::write_file(index, tb::regress::page(report));
    junit.write([&] { return tb::regress::junit(report); });
    const bool to_terminal = terminal_columns() != tb::TableWidth::kUnlimited;
    if (!campaign_.quiet)
      std::cout << (json_         ? tb::regress::json(report)
                    : to_terminal ? tb::regress::table(report)
                                  : tb::regress::tsv(report))
                << std::flush;
    std::cerr << "regression: " << tb::regress::summary(report) << "; " << index << "\n";
  }

  tb::regress::Request request_;  ///< scenarios, engines and views by CLI11, all else by take_request
  Description description_;       ///< also checks, wave and report, and by new_description
  std::string seeds_;             ///< a range; empty: the usual one
  std::vector<std::string> set_;  ///< PATH=VALUES
  std::string keep_, shard_;      ///< empty: failed, all of it
  bool failed_ = false;           ///< what has not passed the last time
  double time_limit_ = 600;       ///< seconds for a run; 0: none
  std::string junit_;             ///< file; empty: none
  bool json_ = false;             ///< the table as JSON
  CampaignArguments campaign_;
};

}  // namespace

std::unique_ptr<Command> make_regress() { return std::make_unique<Regress>(); }

}  // namespace dsdpv1::app

#include "apps/commands/regression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>

#include "apps/commands/command.hpp"
#include "apps/data_folder.hpp"
#include "apps/interrupt.hpp"
#include "apps/terminal.hpp"
#include "cosim/random/ruling_coverage.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "io/output/write_file.hpp"
#include "lab/campaign/contents.hpp"
#include "lab/campaign/fingerprint.hpp"
#include "lab/campaign/jobs.hpp"
#include "lab/coverage/tables.hpp"
#include "lab/regress/page.hpp"
#include "lab/regress/tables.hpp"
#include "lab/traces/golden.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/report/text_table.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {
namespace {

namespace fs = std::filesystem;
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

constexpr int kNotStarted = 127;
constexpr tb::FileKind kCoverageFile{"a tracefile of coverage", 256};  // some 30 bytes a toggle

/// The files of the own RTL, of the scenario and of the golden. A scenario that cannot be read is refused by its run,
/// which says why.
std::vector<std::string> files_of(const Run& run, const Description& description) {
  std::vector<std::string> files;
  if (run.has_own_rtl()) files = description.rtl.files;
  if (run.engine == "random" || !run.not_run.empty()) return files;
  files.push_back(run.scenario);
  if (run.is_stimulus()) return files;
  if (run.engine == "golden") {
    const std::string folder = golden_folder(), name = tb::traces::golden_name(run.scenario);
    files.insert(files.end(), {tb::traces::manifest_path(folder, name), tb::traces::trace_path(folder, name)});
  }
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
                    {"words", description.words(run)},
                    {"checks", description.checks},
                    {"wave", description.wave},
                    {"keep", static_cast<int>(description.keep)},
                    {"report", description.report},
                    {"verilator", run.has_own_rtl() ? description.rtl.verilator : ""},
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
      files_.push_back(files_of(run, description));
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
    const Run& run = plan_.runs[job];
    outcomes_[job] = run.not_run.empty() ? folder_.finished(run, anyhow_ ? "" : inputs_.key(job))
                                         : tb::regress::not_run(run.not_run);
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

int status_of(const Report& report, bool strict) {
  const auto any = [&report](const auto& is) {
    return std::any_of(report.outcomes.begin(), report.outcomes.end(), is);
  };
  const auto judged_nothing = [](const Outcome& each) { return each.verdict == tb::regress::Verdict::kNothingJudged; };
  if (any([&](const Outcome& each) { return each.was_run() && !each.passed() && !judged_nothing(each); }))
    return kFailed;
  const bool all_run = !any([](const Outcome& each) { return !each.was_run(); });
  return report.passed() && (all_run || !strict) ? kPassed : kNothingJudged;
}

/// Once, so that the runs find it as it is.
void build(const std::string& command, tb::regress::OwnRtl& rtl, bool coverage) {
  const tb::ChipKind& kind = *tb::find_chip_kind(rtl.chip);
  const OwnRtl own = build_own_rtl({rtl.folder, rtl.top, rtl.pins, rtl.build, coverage ? "wanted" : ""}, command, kind,
                                   *cosim::usual_options(kind).chip, false);
  const std::string built_from = rtl.build + "/" + cosim::kBuiltFrom;
  rtl.files = {built_from};
  rtl.fingerprint = tb::campaign::last_line(tb::campaign::content(built_from));
  rtl.verilator = cosim::verilator_version();
  for (std::size_t pin = 0; pin < kind.pins().size(); ++pin)
    if (const auto cycles = own.map.tolerances.at(pin)) rtl.tolerance[kind.pins()[pin].name] = cycles;
  if (!rtl.pins.empty()) rtl.files.push_back(rtl.pins);
}

void check_files(const RegressionArguments& arguments, const RegressInputs& inputs, const tb::regress::OwnRtl& rtl) {
  std::vector<NamedFile> read = own_inputs({rtl.folder, rtl.top, rtl.pins, rtl.build});
  for (const auto& file : inputs.contents().all().items()) read.push_back({"a file of a scenario", file.key()});
  std::vector<NamedFile> written = outputs_in(arguments.campaign.out, tb::regress::kind());
  written.push_back({"--junit", arguments.junit});
  check_outputs(arguments.command, read, written);
}

/// How the first failures are seen again.
std::string again_text(const Report& report) {
  constexpr int kMost = 5;
  std::string text;
  int shown = 0;
  for (std::size_t i = 0; i < report.outcomes.size() && shown < kMost; ++i) {
    const Outcome& outcome = report.outcomes[i];
    if (outcome.passed() || !outcome.was_run()) continue;
    text += "again: " + report.again(report.runs()[i], outcome) + "\n";
    ++shown;
  }
  return text;
}

/// The sum of all runs. A run that crashed has no counts.
tb::coverage::Files reached_by(const Plan& plan, const Folder& folder) {
  tb::coverage::Files sum;
  for (const Run& run : plan.runs) {
    const std::string file = folder.counts(run);
    if (run.has_own_rtl() && fs::exists(file))
      tb::coverage::add(sum, tb::coverage::of_lcov(tb::read_file(file, kCoverageFile), file));
  }
  return sum;
}

/// Writes its files; returns its part of the page.
std::string write_coverage(const Plan& plan, const Folder& folder) {
  const tb::coverage::Files reached = reached_by(plan, folder);
  const auto write = [&folder](const char* name, const std::string& text) {
    tb::write_file(folder.base().file(name), text);
  };
  write(tb::regress::kCoverageInfo, tb::coverage::lcov(reached));
  write(tb::regress::kCoverageTable, tb::coverage::tsv(reached));
  write(tb::regress::kNotReached, tb::coverage::missing_tsv(reached));
  std::cerr << "coverage: " << tb::coverage::summary(reached) << "; " << folder.base().file(tb::regress::kCoverageInfo)
            << "\n";
  return tb::coverage::html(reached);
}

cosim::Seen seen_of(const Run& run, const Json& json) {
  cosim::Seen seen;
  for (const auto& [code, times] : json.at("codes").items()) seen.codes[code] = times;
  for (const auto& [group, counts] : json.at("situations").items())
    for (const auto& [name, times] : counts.items()) seen.situations.add({group, name}, times);
  seen.mode = run.mode;
  return seen;
}

/// The same of the rulings, by the runs with the RTL.
std::string write_rulings(const Description& description, const Folder& folder) {
  const std::string& chip = description.rtl.chip;
  cosim::RulingCoverage rulings(*tb::find_chip_kind(chip), ruling_documents(chip));
  std::vector<std::string> names;
  for (const Run& run : description.plan.runs) {
    const Json seen = run.has_own_rtl() ? folder.seen(run) : Json();
    if (!seen.is_null()) rulings.add(names.size(), seen_of(run, seen));
    names.push_back(run.name());
  }
  tb::write_file(folder.base().file(tb::regress::kRulingsInfo), tb::coverage::lcov(rulings.files()));
  tb::write_file(folder.base().file(tb::regress::kRulingsTable), cosim::tsv(rulings));
  std::cerr << "rulings: " << cosim::summary(rulings) << "; " << folder.base().file(tb::regress::kRulingsTable) << "\n";
  return cosim::html(rulings, names);
}

/// Below the table of runs. Files of an earlier call that this one does not write would be wrong.
std::string more_of(const Description& description, const Folder& folder) {
  for (const char* name : {tb::regress::kCoverageInfo, tb::regress::kCoverageTable, tb::regress::kNotReached,
                           tb::regress::kRulingsInfo, tb::regress::kRulingsTable})
    fs::remove(folder.base().file(name));
  if (description.rtl.folder.empty()) return {};
  const std::string reached = description.coverage ? write_coverage(description.plan, folder) : "";
  return reached + write_rulings(description, folder);
}

void write_report(const RegressionArguments& arguments, const Report& report, const Folder& folder, WantedFile& junit) {
  const std::string index = folder.base().file("index.html");
  tb::write_file(index, tb::regress::page(report));
  junit.write([&] { return tb::regress::junit(report); });
  const bool to_terminal = terminal_columns() != tb::TableWidth::kUnlimited;
  if (!arguments.campaign.quiet)
    std::cout << (arguments.json ? tb::regress::json(report)
                  : to_terminal  ? tb::regress::table(report)
                                 : tb::regress::tsv(report))
              << std::flush;
  std::cerr << "regression: " << tb::regress::summary(report) << "; " << index << "\n" << again_text(report);
}

}  // namespace

void add_coverage_flag(CLI::App& app, Description& description) {
  app.add_flag(
         "--coverage", description.coverage,
         "Count which lines, branches and toggles of your RTL are reached: a table in the page, coverage.info for "
         "lcov (takes longer)")
      ->needs("--rtl");
}

void add_regression_options(CLI::App& app, RegressionArguments& arguments, const std::string& usual_folder) {
  app.add_option("--time-limit", arguments.time_limit,
                 "Kill a run after so many seconds and count it as failed; 0: no limit")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  app.add_option("--junit", arguments.junit, "Write the report for CI as JUnit's XML");
  app.add_flag("--json", arguments.json, "Write the table as JSON");
  add_campaign_options(app, arguments.campaign, usual_folder);
}

tb::regress::OwnRtl rtl_of_regression(const OwnRtlArguments& arguments, const std::string& chip) {
  return {arguments.rtl, arguments.top, arguments.pins, arguments.build, chip};
}

int run_regression(Description description, const RegressionArguments& arguments, bool failed) {
  const CampaignArguments& campaign = arguments.campaign;
  if (!description.rtl.folder.empty()) build(arguments.command, description.rtl, description.coverage);
  description.program = tb::campaign::program_identity(DSDPV1_VERSION);
  const RegressInputs inputs(description, description.program);
  if (!campaign.is_task()) check_files(arguments, inputs, description.rtl);
  WantedFile junit(campaign.is_task() ? "" : arguments.junit);
  catch_signals();
  const Folder folder(campaign.out, description, campaign.access());
  if (!campaign.is_task()) remove_stale(folder, description, failed);
  RegressJobs jobs(description.plan, inputs, folder, failed);
  const std::string identity =
      tb::campaign::fingerprint(description.program + tb::campaign::text_of(json_of(description)) +
                                tb::campaign::text_of(inputs.contents().all()));
  std::optional<std::chrono::duration<double>> limit;
  if (arguments.time_limit > 0) limit.emplace(arguments.time_limit);
  if (!carry_out_jobs(campaign, tb::regress::kind(), jobs, folder.base(), identity, limit)) return kInterrupted;
  if (campaign.is_task()) return kPassed;
  const Report report{description, jobs.outcomes(), campaign.out, more_of(description, folder)};
  write_report(arguments, report, folder, junit);
  return status_of(report, arguments.strict);
}

}  // namespace dsdpv1::app

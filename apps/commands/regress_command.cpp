// regress: many runs in child processes or on a cluster, then the tables and the page.
#include "apps/commands/regress_command.hpp"

#include <fmt/format.h>

#include <iostream>
#include <set>

#include "apps/command_line.hpp"
#include "apps/commands/regress_jobs.hpp"
#include "apps/hand_over.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/checks.hpp"
#include "apps/options/outputs.hpp"
#include "apps/terminal.hpp"
#include "io/input/input_error.hpp"
#include "io/output/output_file.hpp"
#include "io/output/write_file.hpp"
#include "lab/campaign/fingerprint.hpp"
#include "lab/regress/page.hpp"
#include "lab/regress/tables.hpp"
#include "tb/report/text_table.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {
namespace {

using tb::regress::Description;
using tb::regress::Folder;
using tb::regress::Report;
using tb::regress::Run;
using tb::regress::Verdict;

/// A list of words, each once; `usual` when none is given.
std::vector<std::string> words_of(const std::string& option, const std::vector<std::string>& given,
                                  const std::vector<std::string>& allowed, const char* usual) {
  if (given.empty()) return {usual};
  std::set<std::string> seen;
  for (const std::string& word : given) {
    check_word("regress: " + option, word, allowed);
    if (!seen.insert(word).second)
      throw tb::InputError(fmt::format("dsdpv1-sim regress: {} has {} twice, allowed is once", option, word));
  }
  return given;
}

/// Other programs than the one with SystemC have no other view.
bool pins_only(const Run& run) {
  try {
    return needs_other_program(tb::scenario::load(run.scenario, tb::scenario::parse_settings(run.settings)));
  } catch (const tb::InputError&) {  // the run says what is wrong
    return false;
  }
}

tb::regress::Request request_of(const RegressArguments& arguments) {
  tb::regress::Request request;
  request.scenarios = arguments.scenarios.empty() ? std::vector<std::string>{"scenarios"} : arguments.scenarios;
  request.engines = words_of("--engine", arguments.engines, {"step", "skip", "rtl", "lockstep"}, "skip");
  request.views = words_of("--view", arguments.views, {"pins", "tlm"}, "pins");
  if (!arguments.seeds.empty()) request.seeds = tb::regress::parse_seeds(arguments.seeds);
  for (const std::string& text : arguments.set) request.parameters.push_back(tb::sweep::parse_parameter(text, "--set"));
  request.pins_only = pins_only;
  return request;
}

Description new_description(const RegressArguments& arguments) {
  checks_mode("regress", arguments.checks);
  if (!arguments.wave.empty()) check_word("regress: --wave", arguments.wave, {"vcd", "fst"});
  if (!arguments.keep.empty()) check_word("regress: --keep", arguments.keep, tb::regress::keep_words());
  const tb::regress::Shard shard =
      arguments.shard.empty() ? tb::regress::Shard() : tb::regress::parse_shard(arguments.shard);
  return {plan_of(request_of(arguments), shard), arguments.checks, arguments.wave,
          tb::regress::keep_named(arguments.keep).value_or(tb::regress::Keep::kFailed), arguments.report};
}

std::string folder_of(const RegressArguments& arguments) {
  return arguments.campaign.out.empty() ? "regression" : arguments.campaign.out;
}

/// What is known and is to be found out again: with --failed all that has not passed; else what may have been the
/// machine's fault.
bool is_stale(const tb::regress::Outcome& outcome, bool failed) {
  if (failed) return !outcome.passed();
  return outcome.verdict == Verdict::kCrashed || outcome.verdict == Verdict::kHung;
}

void remove_stale(const Folder& folder, const Description& description, bool failed) {
  for (const Run& run : description.plan.runs) {
    const auto known = folder.finished(run, "");
    if (known && is_stale(*known, failed)) folder.remove(run);
  }
}

void check_files(const RegressArguments& arguments, const RegressInputs& inputs) {
  std::vector<NamedFile> read;
  for (const auto& file : inputs.contents().all().items()) read.push_back({"a file of a scenario", file.key()});
  std::vector<NamedFile> written = outputs_in(folder_of(arguments), tb::regress::kind());
  written.push_back({"--junit", arguments.junit});
  check_outputs("dsdpv1-sim regress", read, written);
}

void write_report(const RegressArguments& arguments, const Report& report, const Folder& folder,
                  std::optional<tb::OutputFile>& junit) {
  const std::string index = folder.base().file("index.html");
  tb::write_file(index, tb::regress::page(report));
  if (junit) {
    junit->write(tb::regress::junit(report));
    junit->commit();
  }
  const bool to_terminal = terminal_columns() != tb::TableWidth::kUnlimited;
  if (!arguments.campaign.quiet)
    std::cout << (arguments.json ? tb::regress::json(report)
                  : to_terminal  ? tb::regress::table(report)
                                 : tb::regress::tsv(report))
              << std::flush;
  std::cerr << "regression: " << tb::regress::summary(report) << "; " << index << "\n";
}

int status_of(const Report& report) {
  const auto any = [&report](const auto& is) {
    return std::any_of(report.outcomes.begin(), report.outcomes.end(), is);
  };
  const auto judged_nothing = [](const tb::regress::Outcome& each) {
    return each.verdict == tb::regress::Verdict::kNothingJudged;
  };
  if (any([&](const tb::regress::Outcome& each) { return !each.passed() && !judged_nothing(each); })) return kFailed;
  return any(judged_nothing) ? kNothingJudged : kPassed;
}

}  // namespace

int regress(const RegressArguments& arguments) {
  leave_nothing_on_signals();
  const std::string out = folder_of(arguments);
  const Description description = arguments.failed ? tb::regress::last_description(out) : new_description(arguments);
  const std::string program = tb::campaign::program_identity(DSDPV1_VERSION);
  const RegressInputs inputs(description, program);
  if (!arguments.campaign.is_task()) check_files(arguments, inputs);
  std::optional<tb::OutputFile> junit;
  if (!arguments.junit.empty() && !arguments.campaign.is_task()) junit.emplace(arguments.junit);
  catch_signals();
  const Folder folder(out, description, arguments.campaign.access());
  if (!arguments.campaign.is_task()) remove_stale(folder, description, arguments.failed);
  RegressJobs jobs(description.plan, inputs, folder, arguments.failed);
  const std::string identity = tb::campaign::fingerprint(program + tb::campaign::text_of(json_of(description)) +
                                                         tb::campaign::text_of(inputs.contents().all()));
  std::optional<std::chrono::duration<double>> limit;
  if (arguments.time_limit > 0) limit.emplace(arguments.time_limit);
  if (!carry_out(arguments.campaign, tb::regress::kind(), jobs, folder.base(), identity, limit)) return kInterrupted;
  if (arguments.campaign.is_task()) return kPassed;
  const Report report{description.plan, jobs.outcomes()};
  write_report(arguments, report, folder, junit);
  return status_of(report);
}

}  // namespace dsdpv1::app

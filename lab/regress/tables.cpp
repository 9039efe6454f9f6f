#include "lab/regress/tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/printable.hpp"
#include "io/output/shell_word.hpp"
#include "lab/campaign/fingerprint.hpp"
#include "tb/report/junit.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::tb::regress {
namespace {

using campaign::Json;

constexpr Verdict kOthers[] = {Verdict::kFailed,  Verdict::kNothingJudged, Verdict::kRefused,
                               Verdict::kCrashed, Verdict::kHung,          Verdict::kNotRun};

std::size_t count(const Report& report, Verdict verdict) {
  const auto is = [verdict](const Outcome& outcome) { return outcome.verdict == verdict; };
  return static_cast<std::size_t>(std::count_if(report.outcomes.begin(), report.outcomes.end(), is));
}

std::string tsv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) line += (&field == &fields.front() ? "" : "\t") + bus::printable(field);
  return line + "\n";
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string folder_of(const Run& run, const Outcome& outcome) {
  return outcome.files.empty() ? "" : "runs/" + run.file_name();
}

Json json_of(const Report& report, const Run& run, const Outcome& outcome) {
  Json json = regress::json_of(run);
  json.update(regress::json_of(outcome));
  json["folder"] = folder_of(run, outcome);
  json["again"] = report.again(run, outcome);
  return json;
}

JunitCase case_of(const Run& run, const Outcome& outcome) {
  JunitCase made{run.scenario, run.variant(), outcome.seconds, std::nullopt, outcome.log};
  if (!outcome.was_run())
    made.skipped = outcome.reason;
  else if (!outcome.passed())
    made.failure = std::string(name(outcome.verdict)) + ": " + outcome.reason + "\n\n" + outcome.output;
  return made;
}

}  // namespace

std::string Report::again(const Run& run, const Outcome& outcome) const {
  if (std::find(outcome.files.begin(), outcome.files.end(), kAgain) != outcome.files.end())
    return "sh " + shell_word(folder + "/" + folder_of(run, outcome) + "/" + kAgain);
  std::string text = "dsdpv1-sim";
  for (const std::string& word : description.words(run)) text += " " + shell_word(word);
  return text;
}

bool Report::passed() const {
  const std::size_t passed = count(*this, Verdict::kPassed), not_run = count(*this, Verdict::kNotRun);
  return passed + not_run == outcomes.size() && (passed != 0 || not_run == 0);
}

std::string tsv(const Report& report) {
  std::string text = tsv_line(
      {"verdict", "scenario", "engine", "view", "seed", "settings", "exit", "seconds", "reason", "folder", "mode"});
  for (std::size_t i = 0; i < report.outcomes.size(); ++i) {
    const Run& run = report.runs()[i];
    const Outcome& outcome = report.outcomes[i];
    text += tsv_line({name(outcome.verdict), run.scenario, run.engine, run.view, run.seed, joined(run.settings),
                      fmt::format("{}", outcome.exit), fmt::format("{:.3f}", outcome.seconds), outcome.reason,
                      folder_of(run, outcome), run.mode});
  }
  return text;
}

std::string table(const Report& report) {
  TextTable table({"verdict", "scenario", "how", "seconds", "reason"});
  for (std::size_t i = 0; i < report.outcomes.size(); ++i) {
    const Run& run = report.runs()[i];
    const Outcome& outcome = report.outcomes[i];
    table.add(
        {name(outcome.verdict), run.scenario, run.variant(), fmt::format("{:.3f}", outcome.seconds), outcome.reason});
  }
  return table.text();
}

std::string json(const Report& report) {
  const Json description = regress::json_of(report.description);
  Json all = {{"passed", report.passed()},
              {"versions", description["versions"]},
              {"rtl", description["rtl"]},
              {"left_out", report.description.plan.left_out},
              {"counts", Json::object()}};
  all["counts"][name(Verdict::kPassed)] = count(report, Verdict::kPassed);
  for (const Verdict verdict : kOthers) all["counts"][name(verdict)] = count(report, verdict);
  all["runs"] = Json::array();
  for (std::size_t i = 0; i < report.outcomes.size(); ++i)
    all["runs"].push_back(json_of(report, report.runs()[i], report.outcomes[i]));
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string junit(const Report& report) {
  std::vector<JunitCase> cases;
  for (std::size_t i = 0; i < report.outcomes.size(); ++i)
    cases.push_back(case_of(report.runs()[i], report.outcomes[i]));
  return tb::junit("dsdpv1-sim regress", cases);
}

std::string summary(const Report& report) {
  const std::size_t not_run = count(report, Verdict::kNotRun);
  std::string text =
      fmt::format("{} of {} runs passed", count(report, Verdict::kPassed), report.outcomes.size() - not_run);
  for (const Verdict verdict : kOthers)
    if (const std::size_t many = verdict == Verdict::kNotRun ? 0 : count(report, verdict))
      text += fmt::format(", {} {}", many, name(verdict));
  if (not_run != 0) text += fmt::format("; {} are not run", not_run);
  if (report.description.plan.left_out != 0)
    text += fmt::format("; {} combinations that cannot be are left out", report.description.plan.left_out);
  return text;
}

}  // namespace dsdpv1::tb::regress

#include "apps/commands/regress_jobs.hpp"

#include "apps/exit_codes.hpp"
#include "apps/hand_over.hpp"
#include "io/input/input_error.hpp"
#include "lab/campaign/fingerprint.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {
namespace {

using tb::campaign::Ended;
using tb::campaign::Json;
using tb::regress::Description;
using tb::regress::Outcome;
using tb::regress::Plan;
using tb::regress::Run;

constexpr int kNotStarted = 127;

/// With the program that its run is handed over to. A scenario that cannot be read is refused by its run, which says
/// why.
std::vector<std::string> files_of(const Run& run) {
  std::vector<std::string> files = {run.scenario};
  try {
    const auto settings = tb::scenario::parse_settings(run.settings);
    const std::vector<std::string> named = tb::scenario::files(run.scenario, settings);
    files.insert(files.end(), named.begin(), named.end());
    const std::string program = other_program(tb::scenario::load(run.scenario, settings));
    if (!program.empty()) files.push_back(program);
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

}  // namespace

RegressInputs::RegressInputs(const Description& description, const std::string& program)
    : contents_(tb::regress::kind()) {
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

RegressJobs::RegressJobs(const Plan& plan, const RegressInputs& inputs, const tb::regress::Folder& folder, bool anyhow)
    : plan_(plan), inputs_(inputs), folder_(folder), anyhow_(anyhow), outcomes_(plan.runs.size()) {}

bool RegressJobs::look(std::size_t job) {
  outcomes_[job] = folder_.finished(plan_.runs[job], anyhow_ ? "" : inputs_.key(job));
  return finished(job);
}

std::vector<std::string> RegressJobs::begin(std::size_t job) {
  read_[job] = inputs_.look(job);
  return folder_.words(plan_.runs[job]);
}

std::string RegressJobs::end(const Ended& ended) {
  const auto read = read_.extract(ended.job);
  if (says_nothing(ended.exit) || could_not_write(ended, folder_.place(plan_.runs[ended.job]))) return fate(ended);
  if (inputs_.look(ended.job) != read.mapped())
    return "one of its files was written while it ran";  // and has its old content again
  outcomes_[ended.job] = folder_.finish(plan_.runs[ended.job], inputs_.key(ended.job), ended);
  return "";
}

void RegressJobs::forget(std::size_t job) { folder_.forget(plan_.runs[job]); }

std::string RegressJobs::name(std::size_t job) const { return plan_.runs[job].name(); }

std::vector<Outcome> RegressJobs::outcomes() const {
  std::vector<Outcome> all;
  for (const std::optional<Outcome>& outcome : outcomes_) all.push_back(*outcome);
  return all;
}

}  // namespace dsdpv1::app

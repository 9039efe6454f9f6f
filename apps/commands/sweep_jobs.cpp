#include "apps/commands/sweep_jobs.hpp"

#include <fmt/format.h>

#include "apps/exit_codes.hpp"
#include "apps/options/common.hpp"
#include "io/input/input_error.hpp"
#include "tb/bench/bench.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {
namespace {

using tb::campaign::Ended;
using tb::sweep::Plan;
using tb::sweep::Point;

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Why the scenario cannot be run with these settings, empty when it can. Exit code 2 of a run is no proof: a full disk
/// has it too. Here everything is built as for the run, but nothing written.
std::string refusal(const Plan& plan, std::size_t point) {
  try {
    const tb::scenario::Scenario scenario =
        tb::scenario::load(plan.scenario, tb::scenario::parse_settings(plan.settings_of(point)));
    tb::RunOptions options;
    options.checks = checks_mode("dsdpv1-sim sweep", plan.checks);
    const tb::Bench bench(scenario, options, tb::make_pin_execution());
    return "";
  } catch (const tb::InputError& error) {
    return first_line(error.what());
  } catch (const std::exception&) {  // no memory, for example
    return "";
  }
}

}  // namespace

SweepJobs::SweepJobs(const Plan& plan, const tb::sweep::Inputs& inputs, const tb::sweep::Folder& folder)
    : plan_(plan), inputs_(inputs), folder_(folder), points_(plan.points()) {}

bool SweepJobs::look(std::size_t job) {
  points_[job] = folder_.finished(job, plan_);
  return finished(job);
}

std::vector<std::string> SweepJobs::begin(std::size_t job) {
  read_[job] = inputs_.look(job);
  std::vector<std::string> words = {"run",           plan_.scenario, "--quiet",
                                    "--no-progress", "--result",     folder_.result_file(job)};
  for (const std::string& setting : plan_.settings_of(job)) words.insert(words.end(), {"--set", setting});
  if (!plan_.checks.empty()) words.insert(words.end(), {"--checks", plan_.checks});
  return words;
}

/// What the run says about the point, when it does, and has read what all others read.
std::string SweepJobs::end(const Ended& ended) {
  const auto read = read_.extract(ended.job);
  if (ended.exit != kPassed && ended.exit != kFailed && ended.exit != kWrongInput && ended.exit != kNothingJudged)
    return fate(ended);
  const std::string refused = ended.exit == kWrongInput ? refusal(plan_, ended.job) : "";
  if (inputs_.look(ended.job) != read.mapped())
    return "one of its files was written while it ran";  // and has its old content again
  points_[ended.job] = folder_.finish(ended.job, plan_, ended.exit, refused);
  return finished(ended.job) ? "" : fate(ended);
}

void SweepJobs::forget(std::size_t job) { folder_.forget(job); }

std::string SweepJobs::name(std::size_t job) const {
  const std::vector<std::string> values = plan_.values(job);
  std::string name;
  for (std::size_t i = 0; i < values.size(); ++i) name += (i == 0 ? "" : ", ") + plan_.short_name(i) + "=" + values[i];
  return fmt::format("point {} ({})", job, name);
}

std::vector<Point> SweepJobs::points() const {
  std::vector<Point> all;
  for (const std::optional<Point>& point : points_) all.push_back(*point);
  return all;
}

}  // namespace dsdpv1::app

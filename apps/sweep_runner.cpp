#include "apps/sweep_runner.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/command_line.hpp"
#include "apps/interrupt.hpp"
#include "tb/bench/bench.hpp"
#include "tb/input/input_error.hpp"
#include "tb/scenario/scenario.hpp"

namespace app {
namespace {

using tb::sweep::Ended;
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
    options.checks = plan.checks == "fail" ? tb::ChecksMode::kFail : tb::ChecksMode::kReport;
    const tb::Bench bench(scenario, options, tb::make_pin_execution());
    return "";
  } catch (const tb::InputError& error) {
    return first_line(error.what());
  } catch (const std::exception&) {  // no memory, for example
    return "";
  }
}

/// In a few words why a run has no result.
std::string fate(const Ended& ended) {
  if (!ended.said.empty()) return ended.said;
  constexpr int kSignalled = 128;
  if (ended.exit > kSignalled && ended.exit != kInterrupted)
    return fmt::format("its run was killed by signal {}", ended.exit - kSignalled);
  return fmt::format("its run ended with exit code {} and no result", ended.exit);
}

}  // namespace

SweepRunner::SweepRunner(const Plan& plan, const tb::sweep::Inputs& inputs, const tb::sweep::Folder& folder,
                         unsigned jobs, bool progress)
    : plan_(plan),
      inputs_(inputs),
      folder_(folder),
      jobs_(jobs),
      bar_(plan.points(), progress),
      tried_(plan.points(), false) {
  for (std::size_t i = 0; i < plan.points(); ++i) points_.push_back(folder.finished(i, plan));
  done_ = static_cast<std::size_t>(
      std::count_if(points_.begin(), points_.end(), [](const auto& point) { return point.has_value(); }));
  kept_ = done_;
}

bool SweepRunner::run() {
  try {
    run_missing();
  } catch (...) {
    bar_.clear();  // the line that says why stands alone
    throw;
  }
  give_up();
  bar_.clear();
  return done_ == points_.size();
}

void SweepRunner::run_missing() {
  while (done_ < points_.size() && !interrupted()) {
    while (children_.running() < jobs_ && start_next()) {
    }
    if (const std::optional<Ended> ended = children_.wait()) take(*ended);
    bar_.show(done_);
  }
}

std::vector<Point> SweepRunner::points() const {
  std::vector<Point> all;
  for (const std::optional<Point>& point : points_) all.push_back(*point);
  return all;
}

bool SweepRunner::start_next() {
  while (next_ < points_.size() && points_[next_]) ++next_;
  if (next_ == points_.size()) return false;
  read_[next_] = inputs_.look(next_);
  children_.start(next_, arguments(next_));
  ++next_;
  return true;
}

std::vector<std::string> SweepRunner::arguments(std::size_t point) const {
  std::vector<std::string> words = {"run",           plan_.scenario, "--quiet",
                                    "--no-progress", "--result",     folder_.result_file(point)};
  for (const std::string& setting : plan_.settings_of(point)) words.insert(words.end(), {"--set", setting});
  if (!plan_.checks.empty()) words.insert(words.end(), {"--checks", plan_.checks});
  return words;
}

void SweepRunner::take(Ended ended) {
  points_[ended.point] = told(ended);
  read_.erase(ended.point);
  if (points_[ended.point]) {
    ++done_;
    return;
  }
  folder_.forget(ended.point);
  if (!interrupted()) try_again(ended);
}

/// What the run says about the point, when it does, and has read what all others read.
std::optional<Point> SweepRunner::told(Ended& ended) const {
  if (ended.exit != kPassed && ended.exit != kFailed && ended.exit != kWrongInput) return std::nullopt;
  const std::string refused = ended.exit == kWrongInput ? refusal(plan_, ended.point) : "";
  if (inputs_.look(ended.point) == read_.at(ended.point))
    return folder_.finish(ended.point, plan_, ended.exit, refused);
  ended.said = "one of its files was written while it ran";  // and has its old content again
  return std::nullopt;
}

void SweepRunner::try_again(const Ended& ended) {
  if (tried_[ended.point])
    throw tb::InputError(fmt::format("dsdpv1-sim sweep: point {} ({}) cannot be run: {}; {} of {} points are kept",
                                     ended.point, name_of(ended.point), fate(ended), done_, points_.size()));
  tried_[ended.point] = true;
  next_ = std::min(next_, ended.point);
}

std::string SweepRunner::name_of(std::size_t point) const {
  const std::vector<std::string> values = plan_.values(point);
  std::string name;
  for (std::size_t i = 0; i < values.size(); ++i) name += (i == 0 ? "" : ", ") + plan_.short_name(i) + "=" + values[i];
  return name;
}

void SweepRunner::give_up() {
  children_.terminate();
  while (children_.running() != 0)
    if (const std::optional<Ended> ended = children_.wait()) folder_.forget(ended->point);
}

}  // namespace app

// sweep: the points of a plan in child processes, then the tables and pictures.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>

#include "apps/commands/command.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/campaign.hpp"
#include "apps/options/common.hpp"
#include "apps/options/scenario_files.hpp"
#include "apps/options/words.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "io/output/write_file.hpp"
#include "lab/campaign/fingerprint.hpp"
#include "lab/campaign/jobs.hpp"
#include "lab/sweep/folder.hpp"
#include "lab/sweep/heat_map.hpp"
#include "lab/sweep/inputs.hpp"
#include "lab/sweep/plan.hpp"
#include "lab/sweep/point.hpp"
#include "lab/sweep/table.hpp"
#include "tb/bench/bench.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {
namespace {

using tb::sweep::Folder;
using tb::sweep::Plan;
using tb::sweep::Point;

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Why the scenario cannot be run with these settings, empty when it can. Exit code 2 of a run proves nothing: a full
/// disk causes it too. Here everything is built as for the run, but nothing written.
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

/// The points of a sweep as runs of this program.
class SweepJobs : public tb::campaign::Jobs {
 public:
  SweepJobs(const Plan& plan, const tb::sweep::Inputs& inputs, const Folder& folder)
      : plan_(plan), inputs_(inputs), folder_(folder), points_(plan.points()) {}

  std::size_t size() const override { return points_.size(); }
  bool finished(std::size_t job) const override { return points_[job].has_value(); }
  bool look(std::size_t job) override {
    points_[job] = folder_.finished(job, plan_);
    return finished(job);
  }
  std::vector<std::string> begin(std::size_t job) override {
    read_[job] = inputs_.look(job);
    std::vector<std::string> words = {"run",           plan_.scenario, "--quiet",
                                      "--no-progress", "--result",     folder_.result_file(job)};
    for (const std::string& setting : plan_.settings_of(job)) words.insert(words.end(), {"--set", setting});
    if (!plan_.checks.empty()) words.insert(words.end(), {"--checks", plan_.checks});
    return words;
  }
  /// The run's result for the point, if there is one and the run has read the same files as all others.
  std::string end(const tb::campaign::Ended& ended) override {
    const auto read = read_.extract(ended.job);
    if (ended.exit != kPassed && ended.exit != kFailed && ended.exit != kWrongInput && ended.exit != kNothingJudged)
      return fate(ended);
    const std::string refused = ended.exit == kWrongInput ? refusal(plan_, ended.job) : "";
    if (inputs_.look(ended.job) != read.mapped())
      return "one of its files was written while it ran";  // and has its old content again
    points_[ended.job] = folder_.finish(ended.job, plan_, ended.exit, refused);
    return finished(ended.job) ? "" : fate(ended);
  }
  void forget(std::size_t job) override { folder_.forget(job); }
  std::string name(std::size_t job) const override {
    const std::vector<std::string> values = plan_.values(job);
    std::string name;
    for (std::size_t i = 0; i < values.size(); ++i)
      name += (i == 0 ? "" : ", ") + plan_.short_name(i) + "=" + values[i];
    return fmt::format("point {} ({})", job, name);
  }

  /// The results of all points, when all are finished.
  std::vector<Point> points() const {
    std::vector<Point> all;
    for (const std::optional<Point>& point : points_) all.push_back(*point);
    return all;
  }

 private:
  const Plan& plan_;
  const tb::sweep::Inputs& inputs_;
  const Folder& folder_;
  std::vector<std::optional<Point>> points_;
  std::map<std::size_t, tb::sweep::Inputs::Times> read_;  ///< of the runs under way: their files when they began
};

std::vector<NamedFile> inputs_of(const Plan& plan, const tb::sweep::Inputs& inputs) {
  std::vector<std::string> named;
  for (const auto& file : inputs.content().items())
    if (file.key() != plan.scenario) named.push_back(file.key());
  return scenario_inputs(plan.scenario, named);
}

/// A scenario that cannot be read at any point is wrong itself: then nothing is run and no folder made.
void check_loads(const Plan& plan) {
  std::string error;
  for (std::size_t i = 0; i < plan.points(); ++i) {
    try {
      tb::scenario::load(plan.scenario, tb::scenario::parse_settings(plan.settings_of(i)));
      return;
    } catch (const tb::InputError& wrong) {
      if (error.empty()) error = wrong.what();
    }
  }
  throw tb::InputError(error);
}

/// Also a point that cannot be run, because of its GSD files for example.
void check_possible(const std::vector<Point>& points) {
  const bool any = std::any_of(points.begin(), points.end(), [](const Point& point) { return point.possible(); });
  if (!any) throw tb::InputError(points.front().error);
}

void check_map(const std::string& check, const std::vector<Point>& points) {
  const std::vector<std::string> ids = tb::sweep::check_ids(points);
  if (check.empty() || std::find(ids.begin(), ids.end(), check) != ids.end()) return;
  throw tb::InputError("dsdpv1-sim sweep: --map is " + check + tb::did_you_mean(check, ids) + ", expected " +
                       (ids.empty() ? "no checks, the runs have none" : tb::join(ids)));
}

void write_results(const Plan& plan, const std::vector<Point>& points, const Folder& folder, const std::string& map) {
  tb::write_file(folder.file("results.csv"), tb::sweep::csv(plan, points));
  for (const tb::sweep::Picture& picture : tb::sweep::heat_maps(plan, points, map))
    tb::write_file(folder.file(picture.name), picture.svg);
}

/// With --strict. Points that are not possible have not been asked about.
int status_of(const std::vector<Point>& points) {
  const auto any = [&points](bool (*is)(const Point&)) { return std::any_of(points.begin(), points.end(), is); };
  if (any([](const Point& point) { return point.possible() && !point.holds() && point.exit != kNothingJudged; }))
    return kFailed;
  return any([](const Point& point) { return point.exit == kNothingJudged; }) ? kNothingJudged : kPassed;
}

class Sweep : public Command {
 public:
  Sweep() : Command("sweep", "Run a scenario with every combination of some keys' values") {}

  void options(CLI::App& app) override {
    app.add_option("SCENARIO", plan_.scenario, "Scenario in YAML")->required();
    app.add_option("--param", parameters_,
                   "PATH=VALUES, once for each key that varies: user_cpu.fsmc.datast=0..15, "
                   "user_cpu.cycle=40us..100us/20us, baud=12M,6M,500k")
        ->allow_extra_args(false);
    add_set_option(app, plan_.settings);
    app.add_option("--checks", plan_.checks, "As for run, report or fail (default: as for run)");
    app.add_flag("--strict", strict_, "Exit with 1 when a point does not hold, with 3 when one judged nothing");
    app.add_option("--map", map_, "Check whose margin the pictures show (default: the worst of all)")
        ->type_name("CHECK");
    add_campaign_options(app, campaign_, "sweep_ and the scenario's name");
    app.footer(
        "\nExamples:\n"
        "  dsdpv1-sim sweep scenarios/power_on_12m.yaml --param user_cpu.fsmc.datast=0..15 --param "
        "user_cpu.fsmc.addset=0..3\n"
        "  dsdpv1-sim sweep my.yaml --set user_cpu.fsmc.mode=A --param user_cpu.fsmc.datast=1..8 --out mode_a\n"
        "  dsdpv1-sim sweep my.yaml --param baud=12M,6M,500k --param slaves.plant.user_cpu.cycle=40us..200us/20us "
        "--jobs 4\n"
        "The same command resumes an interrupted sweep. docs/sweep.md explains the results.\n"
        "\nExit codes: 0 all points were run, whatever they showed (--strict: and hold, else 1 or 3), 2 wrong input, "
        "130 interrupted.\n");
  }

  int carry_out() override {
    leave_nothing_on_signals();
    take_words();
    plan_.scenario = scenario_file("dsdpv1-sim sweep", plan_.scenario);
    tb::campaign::fingerprint_of_file(plan_.scenario);  // refuses what can be read only once, before it is read
    check_loads(plan_);
    const tb::sweep::Inputs inputs(plan_);
    if (!campaign_.is_task())  // its own output is in the folder
      check_outputs("dsdpv1-sim sweep", inputs_of(plan_, inputs), outputs_in(campaign_.out, tb::sweep::kind()));
    catch_signals();
    const tb::campaign::Json identity =
        tb::sweep::identity(plan_, inputs, tb::campaign::program_identity(DSDPV1_VERSION));
    const Folder folder(campaign_.out, identity, campaign_.access());
    if (!folder.started_anew().empty())
      std::cerr << "sweep: " << campaign_.out << " is about " << folder.started_anew()
                << ": its points are removed, the sweep starts again\n";
    SweepJobs jobs(plan_, inputs, folder);
    const std::string all_inputs = tb::campaign::fingerprint(tb::campaign::text_of(identity));
    if (!carry_out_jobs(campaign_, tb::sweep::kind(), jobs, folder.base(), all_inputs)) return kInterrupted;
    return campaign_.is_task() ? kPassed : show(jobs.points(), folder);
  }

 private:
  void take_words() {
    if (!plan_.checks.empty()) check_word("dsdpv1-sim sweep: --checks", plan_.checks, {"report", "fail"});
    for (const tb::scenario::Setting& setting : tb::scenario::parse_settings(plan_.settings))
      tb::scenario::check(setting);
    for (const std::string& text : parameters_) plan_.parameters.push_back(tb::sweep::parse_parameter(text));
    tb::sweep::check(plan_);
    if (campaign_.out.empty()) campaign_.out = "sweep_" + std::filesystem::path(plan_.scenario).stem().string();
    campaign_.words = words;
  }

  int show(const std::vector<Point>& points, const Folder& folder) const {
    check_possible(points);
    check_map(map_, points);
    write_results(plan_, points, folder, map_);
    if (!campaign_.quiet)
      std::cout << tb::sweep::summary(plan_, points) << "  written: " << folder.file("results.csv") << " and map*.svg\n"
                << std::flush;
    return strict_ ? status_of(points) : kPassed;
  }

  Plan plan_;
  std::vector<std::string> parameters_;  ///< PATH=VALUES
  bool strict_ = false;                  ///< the exit code follows the points
  std::string map_;                      ///< the check whose margin the pictures show; empty: the worst
  CampaignArguments campaign_;
};

}  // namespace

std::unique_ptr<Command> make_sweep() { return std::make_unique<Sweep>(); }

}  // namespace dsdpv1::app

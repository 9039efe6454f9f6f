// sweep: the points of a plan in child processes, then the tables and pictures.
#include "apps/commands/sweep_command.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "apps/command_line.hpp"
#include "apps/commands/sweep_jobs.hpp"
#include "apps/hand_over.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/outputs.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "io/output/write_file.hpp"
#include "lab/campaign/fingerprint.hpp"
#include "lab/sweep/folder.hpp"
#include "lab/sweep/heat_map.hpp"
#include "lab/sweep/inputs.hpp"
#include "lab/sweep/plan.hpp"
#include "lab/sweep/point.hpp"
#include "lab/sweep/table.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {
namespace {

using tb::sweep::Folder;
using tb::sweep::Plan;
using tb::sweep::Point;

Plan plan_of(const SweepArguments& arguments) {
  if (!arguments.checks.empty()) check_word("sweep: --checks", arguments.checks, {"report", "fail"});
  Plan plan{arguments.scenario, arguments.set, arguments.checks, {}};
  for (const tb::scenario::Setting& setting : tb::scenario::parse_settings(arguments.set)) tb::scenario::check(setting);
  for (const std::string& text : arguments.parameters) plan.parameters.push_back(tb::sweep::parse_parameter(text));
  tb::sweep::check(plan);
  return plan;
}

std::string folder_of(const SweepArguments& arguments) {
  if (!arguments.campaign.out.empty()) return arguments.campaign.out;
  return "sweep_" + std::filesystem::path(arguments.scenario).stem().string();
}

std::vector<NamedFile> inputs_of(const Plan& plan, const tb::sweep::Inputs& inputs) {
  std::vector<std::string> named;
  for (const auto& file : inputs.content().items())
    if (file.key() != plan.scenario) named.push_back(file.key());
  return scenario_inputs(plan.scenario, named);
}

/// A scenario that cannot be read at any point is wrong itself: then nothing is run and no folder made. One point tells
/// whether it is another program's: the kind of a user CPU and its other keys go together, so no sweep varies it.
void check_loads(const Plan& plan) {
  std::string error;
  for (std::size_t i = 0; i < plan.points(); ++i) {
    try {
      return hand_over(tb::scenario::load(plan.scenario, tb::scenario::parse_settings(plan.settings_of(i))));
    } catch (const tb::InputError& wrong) {
      if (error.empty()) error = wrong.what();
    }
  }
  throw tb::InputError(error);
}

/// Likewise one that cannot be run, because of its GSD files for example.
void check_possible(const std::vector<Point>& points) {
  const bool any = std::any_of(points.begin(), points.end(), [](const Point& point) { return point.possible(); });
  if (!any) throw tb::InputError(points.front().error);
}

void check_map(const std::string& check, const std::vector<Point>& points) {
  const std::vector<std::string> ids = tb::sweep::check_ids(points);
  if (check.empty() || std::find(ids.begin(), ids.end(), check) != ids.end()) return;
  throw tb::InputError("dsdpv1-sim sweep: --map is " + check + tb::did_you_mean(check, ids) + ", allowed are " +
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

}  // namespace

int sweep(const SweepArguments& arguments) {
  leave_nothing_on_signals();
  const Plan plan = plan_of(arguments);
  tb::campaign::fingerprint_of_file(plan.scenario);  // refuses what can be read only once, before it is read
  check_loads(plan);
  const tb::sweep::Inputs inputs(plan);
  const std::string out = folder_of(arguments);
  if (!arguments.campaign.is_task())  // its own output is in the folder
    check_outputs("dsdpv1-sim sweep", inputs_of(plan, inputs), outputs_in(out, tb::sweep::kind()));
  catch_signals();
  const tb::campaign::Json identity = tb::sweep::identity(plan, inputs, tb::campaign::program_identity(DSDPV1_VERSION));
  const Folder folder(out, identity, arguments.campaign.access());
  if (!folder.started_anew().empty())
    std::cerr << "sweep: " << out << " is about " << folder.started_anew()
              << ": its points are removed, the sweep starts again\n";
  SweepJobs jobs(plan, inputs, folder);
  const std::string all_inputs = tb::campaign::fingerprint(tb::campaign::text_of(identity));
  if (!carry_out(arguments.campaign, tb::sweep::kind(), jobs, folder.base(), all_inputs)) return kInterrupted;
  if (arguments.campaign.is_task()) return kPassed;
  const std::vector<Point> points = jobs.points();
  check_possible(points);
  check_map(arguments.map, points);
  write_results(plan, points, folder, arguments.map);
  if (!arguments.campaign.quiet)
    std::cout << tb::sweep::summary(plan, points) << "  written: " << folder.file("results.csv") << " and map*.svg\n"
              << std::flush;
  return arguments.strict ? status_of(points) : kPassed;
}

}  // namespace dsdpv1::app

// sweep: the points of a plan in child processes, then the tables and pictures.
#include "apps/sweep_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <thread>

#include "apps/command_line.hpp"
#include "apps/interrupt.hpp"
#include "apps/outputs.hpp"
#include "apps/sweep_runner.hpp"
#include "tb/input/input_error.hpp"
#include "tb/input/suggest.hpp"
#include "tb/output/output_file.hpp"
#include "tb/scenario/scenario.hpp"
#include "tb/sweep/fingerprint.hpp"
#include "tb/sweep/folder.hpp"
#include "tb/sweep/heat_map.hpp"
#include "tb/sweep/inputs.hpp"
#include "tb/sweep/plan.hpp"
#include "tb/sweep/point.hpp"
#include "tb/sweep/table.hpp"

namespace app {
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
  if (!arguments.out.empty()) return arguments.out;
  return "sweep_" + std::filesystem::path(arguments.scenario).stem().string();
}

std::vector<NamedFile> inputs_of(const Plan& plan, const tb::sweep::Inputs& inputs) {
  std::vector<std::string> named;
  for (const auto& file : inputs.content().items())
    if (file.key() != plan.scenario) named.push_back(file.key());
  return scenario_inputs(plan.scenario, named);
}

/// What is written or removed there, of which what is there already can be an input or lead to one.
std::vector<NamedFile> outputs_in(const std::string& folder) {
  std::vector<NamedFile> outputs;
  for (const std::filesystem::path& file : tb::sweep::own_files(folder))
    outputs.push_back({file.lexically_relative(folder).string() + " of --out", file.string()});
  return outputs;
}

void write(const std::string& path, const std::string& text) {
  tb::OutputFile file(path);
  file.write(text);
  file.commit();
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
  write(folder.file("results.csv"), tb::sweep::csv(plan, points));
  for (const tb::sweep::Picture& picture : tb::sweep::heat_maps(plan, points, map))
    write(folder.file(picture.name), picture.svg);
}

unsigned jobs_of(const SweepArguments& arguments) {
  return arguments.jobs != 0 ? arguments.jobs : std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace

int sweep(const SweepArguments& arguments) {
  leave_nothing_on_signals();
  const Plan plan = plan_of(arguments);
  tb::sweep::fingerprint_of_file(plan.scenario);  // refuses what can be read only once, before it is read
  check_loads(plan);
  const tb::sweep::Inputs inputs(plan);
  check_outputs("dsdpv1-sim sweep", inputs_of(plan, inputs), outputs_in(folder_of(arguments)));
  catch_signals();
  const Folder folder(folder_of(arguments),
                      tb::sweep::identity(plan, inputs, tb::sweep::program_identity(DSDPV1_VERSION)));
  if (!folder.started_anew().empty())
    std::cerr << "sweep: " << folder_of(arguments) << " is about " << folder.started_anew()
              << ": its points are removed, the sweep starts again\n";
  SweepRunner runner(plan, inputs, folder, jobs_of(arguments), arguments.progress.value_or(isatty(STDERR_FILENO) != 0));
  if (runner.kept() != 0)
    std::cerr << fmt::format("sweep: {} of {} points are there already\n", runner.kept(), plan.points());
  if (!runner.run()) {
    std::cerr << fmt::format("sweep: interrupted, {} of {} points are kept; the same command goes on from there\n",
                             runner.done(), plan.points());
    return kInterrupted;
  }
  const std::vector<Point> points = runner.points();
  check_possible(points);
  check_map(arguments.map, points);
  write_results(plan, points, folder, arguments.map);
  if (!arguments.quiet)
    std::cout << tb::sweep::summary(plan, points) << "  written: " << folder.file("results.csv") << " and map*.svg\n"
              << std::flush;
  return kPassed;
}

}  // namespace app

// The command line of traces.
#include <CLI/CLI.hpp>

#include "apps/commands/traces_command.hpp"

namespace dsdpv1::app {
namespace {

CLI::App* add_action(CLI::App& traces, TracesArguments& arguments, const std::string& name, const char* text) {
  CLI::App* action = traces.add_subcommand(name, text);
  action->callback([&arguments, name] { arguments.action = name; });
  action->add_option("--folder", arguments.folder,
                     "Folder of the golden traces; left out: traces of this source tree, whose scenarios are meant by "
                     "names");
  return action;
}

void add_scenarios(CLI::App& action, TracesArguments& arguments) {
  action.add_option("SCENARIO", arguments.scenarios, "Scenarios by name or path; left out: all of scenarios/");
  action.add_flag_callback(
      "--no-progress", [&arguments] { arguments.progress = false; }, "Show no progress bar");
}

}  // namespace

void describe_traces(CLI::App& app, TracesArguments& arguments) {
  CLI::App* traces = app.add_subcommand("traces", "Golden traces of all pins: what a chip has to do in each scenario");
  traces->require_subcommand(0, 1);  // traces() says in its own words what is missing
  CLI::App* check = add_action(*traces, arguments, "check", "Runs scenarios and compares every change of every pin");
  add_scenarios(*check, arguments);
  check->add_option("--engine", arguments.engine, "As of run: step, skip, rtl, lockstep")->capture_default_str();
  check->add_option("--fault", arguments.fault, "With this single fault of rtl_ref/faults.txt in the reference RTL")
      ->check(CLI::Range(0, 255));
  CLI::App* regenerate = add_action(*traces, arguments, "regenerate",
                                    "Makes goldens again, writes those that are others, and says what changed");
  add_scenarios(*regenerate, arguments);
  CLI::App* list = add_action(*traces, arguments, "list", "What there is");
  CLI::App* wave = add_action(*traces, arguments, "wave", "Writes a golden as a wave");
  wave->add_option("SCENARIO", arguments.golden, "Its name, or the scenario's path")->required();
  wave->add_option("FILE", arguments.output, "FILE.vcd or FILE.fst")->required();
  const char* const footer =
      "\nExamples:\n  dsdpv1-sim traces check\n  dsdpv1-sim traces check power_on_12m --engine rtl\n"
      "  dsdpv1-sim traces regenerate scenarios/power_on_12m.yaml\n  dsdpv1-sim traces wave power_on_12m golden.fst\n"
      "docs/traces.md says what they are.\n"
      "\nExit codes: 0 no difference, 1 a difference, 2 wrong input, 130 interrupted.\n";
  for (CLI::App* each : {traces, check, regenerate, list, wave}) each->footer(footer);
}

}  // namespace dsdpv1::app

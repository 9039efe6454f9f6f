#include "apps/commands/scenario_run.hpp"

#include <algorithm>
#include <functional>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "apps/exit_codes.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/rewind.hpp"
#include "apps/options/saved_runs.hpp"
#include "apps/options/scenario_files.hpp"
#include "apps/options/words.hpp"
#include "bus/printable.hpp"
#include "cosim/reference_rtl.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "kinds/dsdpv1/tlm/tlm_execution.hpp"
#include "lab/traces/golden_run.hpp"
#include "tb/report/html/report_file.hpp"
#include "tb/report/progress.hpp"
#include "tb/report/result_fields.hpp"
#include "tb/report/run_junit.hpp"
#include "tb/report/summary.hpp"

namespace dsdpv1::app {
namespace {

void check_golden(const RunArguments& arguments) {
  if (arguments.fault != 0 && arguments.engine != "rtl" && arguments.engine != "lockstep")
    throw tb::InputError("dsdpv1-sim run: --fault is one of the RTL, it needs --engine rtl or lockstep");
  if (arguments.golden.empty()) return;
  if (arguments.view != "pins") throw tb::InputError("dsdpv1-sim run: --golden is about pins, it needs --view pins");
  if (!arguments.set.empty())
    throw tb::InputError("dsdpv1-sim run: --golden is about the scenario as it stands, it excludes --set");
}

}  // namespace

void check_has_board(const std::string& program, const tb::scenario::Scenario& scenario) {
  if (std::any_of(scenario.slaves.begin(), scenario.slaves.end(),
                  [](const tb::scenario::Slave& slave) { return slave.kind->has_debugger(slave); }))
    return;
  throw tb::InputError(program + ": --gdb needs a slave whose user_cpu has kind: arm, " + scenario.file + " has none");
}

tb::RunOptions options_of(const RunArguments& arguments) {
  check_word("dsdpv1-sim run: --engine", arguments.engine, {"step", "skip", "rtl", "lockstep"});
  check_word("dsdpv1-sim run: --view", arguments.view, {"pins", "tlm"});
  if (arguments.view == "tlm" && arguments.engine != "step" && arguments.engine != "skip")
    throw tb::InputError("dsdpv1-sim run: --engine " + arguments.engine + " is about pins, it needs --view pins");
  if (arguments.wave.inside && (arguments.view != "pins" || arguments.engine == "rtl"))
    throw tb::InputError(
        "dsdpv1-sim run: --wave-inside is about the model, it needs --view pins and --engine step, skip or "
        "lockstep");
  check_golden(arguments);
  if (arguments.seed && (arguments.engine == "step" || arguments.engine == "skip"))
    throw tb::InputError("dsdpv1-sim run: --seed is for RTL, it needs --engine rtl, lockstep");
  if (!arguments.difference.empty()) tb::check_wave_name(arguments.difference);
  tb::RunOptions options;
  options.engine = arguments.engine == "step" ? tb::Engine::kStep : tb::Engine::kSkip;
  options.engine_name = arguments.engine;
  options.view_name = arguments.view;
  options.log = arguments.log;
  options.log_whole = arguments.log_whole;
  options.trace = arguments.trace;
  options.capture = capture_request("dsdpv1-sim run", arguments.capture);
  const auto say = [](const std::string& line) { std::cerr << line << '\n'; };
  if (arguments.gdb)
    options.gdb = tb::GdbRequest{arguments.gdb, say, interrupted, std::make_shared<user_cpu::DebugHistory>(),
                                 arguments.view == "pins"};  // a process can simulate with SystemC only once
  if (!arguments.quiet) {
    options.on_text = [](const std::string& station, const std::string& line) {
      std::cout << station << "| " << bus::printable(line) << '\n' << std::flush;
    };
  }
  options.checks = checks_mode("dsdpv1-sim run", arguments.checks);
  return options;
}

namespace {

/// The additional results of a run in lockstep.
struct LockstepSteps {
  std::function<void(tb::RunResult&)> judge;  ///< before the result is written
  std::function<bool()> report;               ///< while the bench still exists; false: the two differ
};

/// `of_golden`: what the comparison with a golden trace says; empty when there was none.
std::string junit_of(const tb::RunResult& result, const std::string& of_golden, bool same) {
  std::vector<tb::JunitCase> cases = tb::run_cases(result);
  if (!of_golden.empty())
    cases.push_back({result.file, "golden trace", 0, same ? std::nullopt : std::optional(of_golden), of_golden});
  return tb::junit("dsdpv1-sim run", cases);
}

/// Exit code of a run in which a debugger steps back, see DebugHistory: the run must be repeated.
constexpr int kGoesBack = -1;

bool goes_back(const RunRequest& request) {
  return request.options.gdb && request.options.gdb->history->back.has_value();
}

/// The files written at the end of a run, each complete or absent.
class ResultFiles {
 public:
  /// The report adds its observer to `options`.
  ResultFiles(const RunArguments& arguments, const tb::scenario::Scenario& scenario, tb::RunOptions& options)
      : result_(arguments.result), junit_(arguments.junit) {
    if (!arguments.report.empty()) report_.emplace(arguments.report, scenario, options);
  }

  void write(const tb::RunResult& result) {
    result_.write([&] { return tb::result_json(result); });
    if (report_) report_->write(result, DSDPV1_VERSION);
  }
  void write_junit(const tb::RunResult& result, const std::string& of_golden, bool same) {
    junit_.write([&] { return junit_of(result, of_golden, same); });
  }

 private:
  WantedFile result_, junit_;
  std::optional<tb::html::ReportFile> report_;
};

int run_scenario(const RunRequest& request, std::unique_ptr<tb::Execution> execution,
                 const LockstepSteps& lockstep = {}) {
  const tb::scenario::Scenario& scenario = request.scenario;
  const RunArguments& arguments = request.arguments;
  tb::RunOptions options = request.options;
  tb::traces::GoldenRun golden(arguments.golden, scenario, execution->segment(), options);
  ResultFiles files(arguments, scenario, options);
  SavedRuns saved(arguments, request.described, request.restored ? &*request.restored : nullptr, scenario.end);
  saved.ask(options);
  Rewind rewind(arguments, scenario);
  rewind.ask(options);
  tb::Bench bench(scenario, options, std::move(execution));
  tb::Progress progress(scenario.end, shows_progress(arguments.progress));
  catch_signals();
  const auto goes_on = [&](tb::Tick now) {
    if (!rewind.is_copy()) progress.show(now);
    return !interrupted() && !golden.over(now) && rewind.look(now);
  };
  tb::RunResult result = rewind.carry_out(bench, goes_on);
  progress.clear();
  if (goes_back(request)) return kGoesBack;
  saved.check(result.interrupted);
  if (rewind.failed()) return kWrongInput;
  if (lockstep.judge) lockstep.judge(result);
  files.write(result);
  if (arguments.wave.save && !(rewind.wanted() && !rewind.recorded()))
    write_save_files(arguments.wave.file, kinds(scenario));
  if (!rewind.wanted() && bench.wave_is_empty()) std::cerr << nothing_recorded(arguments.wave) << '\n';
  const bool ran_through = !lockstep.report || lockstep.report();
  if (!arguments.quiet && ran_through)
    std::cout << tb::summary(result, arguments.check_rows) << rewind.report() << std::flush;
  const bool broken_off = result.interrupted && golden.same();
  const std::string of_golden = ran_through && !broken_off ? golden.report() : "";
  std::cout << of_golden << std::flush;
  files.write_junit(result, of_golden, golden.same());
  if (broken_off) return kInterrupted;
  return golden.same() ? exit_code(verdict(result)) : kFailed;
}

}  // namespace

LockstepOutcome run_lockstep(const RunRequest& request, cosim::MakeRtl make, const cosim::LockstepOptions& lockstep) {
  auto made = std::make_unique<cosim::LockstepExecution>(std::move(make), lockstep);
  cosim::LockstepExecution& execution = *made;
  LockstepOutcome outcome;
  LockstepSteps steps;
  steps.judge = [&](tb::RunResult& result) { result.lockstep = execution.result(); };
  steps.report = [&] {
    std::string text;
    const bool same = cosim::report(execution, request.arguments.difference, text);
    std::cout << text << std::flush;
    if (same) return true;
    outcome.difference = execution.different()->difference();
    outcome.inputs = execution.different()->inputs();
    return false;
  };
  outcome.status = run_scenario(request, std::move(made), steps);
  return outcome;
}

namespace {

void check_view(const RunArguments& arguments, const tb::scenario::Scenario& scenario) {
  if (arguments.view == "tlm" && tb::scenario::needs_pins(scenario))
    throw tb::InputError("dsdpv1-sim run: --view tlm has transactions at the chips' ports, and in " + scenario.file +
                         " a user CPU moves their pins, expected --view pins");
}

void check_outputs_of(const RunArguments& arguments, const tb::scenario::Scenario& scenario) {
  std::vector<NamedFile> outputs = wave_files("dsdpv1-sim run", arguments.wave.file, arguments.wave.save);
  outputs.insert(outputs.end(), {{"--log", arguments.log},
                                 {"--result", arguments.result},
                                 {"--report", arguments.report},
                                 {"--junit", arguments.junit},
                                 {"--trace", arguments.trace},
                                 {"--capture", arguments.capture.file},
                                 {"--difference", arguments.engine == "lockstep" ? arguments.difference : ""}});
  for (NamedFile& file : save_files(arguments)) outputs.push_back(std::move(file));
  std::vector<NamedFile> inputs = scenario_inputs(arguments.scenario, scenario.files);
  inputs.push_back({"the saved run", arguments.restore});
  check_outputs("dsdpv1-sim run", inputs, outputs);
}

/// From the command line; throws tb::InputError.
RunRequest scenario_request(RunArguments arguments) {
  arguments.scenario = scenario_file("dsdpv1-sim run", arguments.scenario);
  RunRequest request{arguments, {}, options_of(arguments), {}, {}};
  const std::string text = tb::read_file(arguments.scenario, tb::kScenarioFile);
  request.scenario = tb::scenario::parse(text, arguments.scenario, tb::scenario::parse_settings(arguments.set));
  request.described = described_run(arguments, text, request.scenario);
  return request;
}

/// From a saved run.
RunRequest restored_request(const RunArguments& arguments) {
  tb::SavedRun saved = tb::parse_saved_run(tb::read_file(arguments.restore, tb::kSavedRunFile), arguments.restore);
  provide_files(saved, arguments.restore);
  RunRequest request{arguments_of(arguments, saved), {}, {}, {}, {}};
  request.options = options_of(request.arguments);
  const std::string& text = saved.files.front().content;
  request.scenario = tb::scenario::parse(text, saved.scenario, tb::scenario::parse_settings(saved.settings));
  request.described = described_run(request.arguments, text, request.scenario);
  replay_debugger(request.options, saved);
  request.restored = std::move(saved);
  return request;
}

RunRequest request_of(const RunArguments& arguments) {
  if (arguments.scenario.empty() && arguments.restore.empty())
    throw tb::InputError("dsdpv1-sim run: a scenario is missing (dsdpv1-sim run FILE.yaml, or --restore FILE)");
  return arguments.restore.empty() ? scenario_request(arguments) : restored_request(arguments);
}

/// Repeats the run each time that a debugger goes back. Output of user CPUs is shown once.
int forth_and_back(RunRequest& request, const std::function<int()>& carry_out) {
  const auto show = request.options.on_text;
  std::size_t shown = 0, line = 0;
  if (show) {
    request.options.on_text = [&](const std::string& station, const std::string& text) {
      if (++line <= shown) return;
      shown = line;
      show(station, text);
    };
  }
  for (;;) {
    const int status = carry_out();
    if (!goes_back(request)) return status;
    request.options.gdb->history->begin_again();
    if (!request.restored && !request.described.files.empty())  // the debugger may have changed the firmware's file
      request.described = described_run(request.arguments, request.described.files.front().content, request.scenario);
    line = 0;
  }
}

}  // namespace

int run(const RunArguments& given, const cosim::MakeRtl& own) {
  leave_nothing_on_signals();
  RunRequest request = request_of(given);
  const RunArguments& arguments = request.arguments;
  request.options.wave = wave_options("dsdpv1-sim run", arguments.wave, kinds(request.scenario));
  check_outputs_of(arguments, request.scenario);
  check_view(arguments, request.scenario);
  if (arguments.gdb) check_has_board("dsdpv1-sim run", request.scenario);
  const cosim::MakeRtl rtl =
      own ? own : cosim::reference_rtl(arguments.fault, arguments.seed.value_or(cosim::kUsualSeed));
  if (arguments.engine == "lockstep") return forth_and_back(request, [&] { return run_lockstep(request, rtl).status; });
  if (arguments.engine == "rtl")
    return forth_and_back(request, [&] { return run_scenario(request, cosim::make_rtl_execution(rtl)); });
  if (arguments.view == "pins")
    return forth_and_back(
        request, [&] { return run_scenario(request, tb::make_pin_execution()); });
  return tb::inside_systemc([&request] { return run_scenario(request, tb::make_tlm_execution()); });
}

}  // namespace dsdpv1::app

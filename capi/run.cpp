// Scenarios: the bench as the object of a handle.
#include "dsdpv1/run.h"
#include "capi/names.hpp"

#include <deque>
#include <memory>
#include <optional>

#include "capi/clock.hpp"
#include "capi/run_watch.hpp"
#include "capi/scenario.hpp"
#include "capi/sized.hpp"
#include "tb/bench/bench.hpp"
#include "tb/bench/verdict.hpp"
#include "tb/report/result_fields.hpp"
#include "tb/report/summary.hpp"

using capi::fail;
using capi::guarded;
using capi::need;
using tb::scenario::Scenario;

struct dpsim_run {
  dpsim_run(Scenario loaded, tb::RunOptions its_options)
      : scenario(std::move(loaded)), options(std::move(its_options)) {}

  const Scenario scenario;
  tb::RunOptions options;
  capi::RunWatch watch{scenario};
  bool begun = false;
  std::optional<tb::RunResult> result;
  std::string json, report, verdict;
};

namespace {

std::string text_of(const char* text) { return text == nullptr ? "" : text; }

// It needs libdw, which programs that use this library need not have.
void refuse_boards(const Scenario& scenario) {
  for (const tb::scenario::Slave& slave : scenario.slaves)
    if (slave.kind->has_debugger(slave))
      fail(DPSIM_ERR_UNSUPPORTED, scenario.file + ":" + std::to_string(slave.user_cpu.line) + ": slave " +
                                      slave.name.text +
                                      " has an ARM board, allowed in this library are kind: native and process; "
                                      "dsdpv1-sim runs it");
}

std::optional<tb::ChecksMode> checks_of(dpsim_checks_mode mode) {
  capi::need_range("checks", mode, DPSIM_CHECKS_AS_SCENARIO, DPSIM_CHECKS_REPORT);
  switch (mode) {
    case DPSIM_CHECKS_FAIL: return tb::ChecksMode::kFail;
    case DPSIM_CHECKS_OFF: return tb::ChecksMode::kOff;
    case DPSIM_CHECKS_REPORT: return tb::ChecksMode::kReport;
    default: return std::nullopt;
  }
}

tb::RunOptions options_of(const dpsim_run_options& given) {
  capi::need_range("engine", given.engine, DPSIM_ENGINE_SKIP, DPSIM_ENGINE_STEP);
  tb::RunOptions options;
  options.engine = given.engine == DPSIM_ENGINE_STEP ? tb::Engine::kStep : tb::Engine::kSkip;
  options.engine_name = given.engine == DPSIM_ENGINE_STEP ? "step" : "skip";
  options.checks = checks_of(given.checks);
  options.log = text_of(given.log);
  options.wave.path = text_of(given.wave);
  if (!options.wave.path.empty()) tb::check_wave_name(options.wave.path);
  options.capture.path = text_of(given.capture);
  options.capture.application = std::string("libdsdpv1 ") + dpsim_version();
  return options;
}

std::unique_ptr<tb::Bench> make_bench(dpsim_run& run) {
  auto execution = tb::make_pin_execution();
  if (run.watch.wants_pins()) {
    run.watch.listen(execution->segment());
    run.options.observers = {&run.watch};
  }
  auto bench = std::make_unique<tb::Bench>(run.scenario, run.options, std::move(execution));
  if (!run.watch.wants_pins()) bench->add_observer(run.watch);
  return bench;
}

/// Before the run.
dpsim_run& open_of(dpsim_run* run) {
  need(run, "run");
  if (run->begun) fail(DPSIM_ERR_STATE, "the run has begun, this is allowed before");
  return *run;
}

const tb::RunResult& result_of(const dpsim_run* run) {
  need(run, "run");
  if (!run->result) fail(DPSIM_ERR_STATE, "the run has not ended, this is allowed after dpsim_run_execute");
  return *run->result;
}

dpsim_run_summary summary_of(const tb::RunResult& result) {
  dpsim_run_summary summary{};
  summary.passed = tb::verdict(result) == tb::Verdict::kPassed ? 1 : 0;
  summary.interrupted = result.interrupted ? 1 : 0;
  summary.simulated = static_cast<std::uint64_t>(result.simulated);
  summary.telegrams = result.telegrams;
  summary.wrong_telegrams = result.wrong_telegrams;
  summary.violations = result.violations;
  summary.expectations = result.expectations.size();
  for (const tb::ExpectationResult& each : result.expectations) summary.expectations_met += each.passed ? 1 : 0;
  summary.wall_seconds = result.wall_s;
  return summary;
}

}  // namespace

dpsim_status dpsim_run_create(const dpsim_run_options* options, dpsim_run** run) {
  return guarded(
      __func__,
      [&] {
        need(options, "options");
        need(run, "run");
        const dpsim_run_options given = capi::options_of(options, "options");
        auto made = std::make_unique<dpsim_run>(capi::load_scenario(given), options_of(given));
        refuse_boards(made->scenario);
        // Faults of the scenario and its files are found now; the files of the run are made later.
        tb::RunOptions trial = made->options;
        trial.log = trial.wave.path = trial.capture.path = "";
        const tb::Bench bench(made->scenario, trial, tb::make_pin_execution());
        *run = made.release();
      });
}

void dpsim_run_destroy(dpsim_run* run) { delete run; }

dpsim_status dpsim_run_get_info(const dpsim_run* run, dpsim_run_info* info) {
  return guarded(
      __func__,
      [&] {
        need(run, "run");
        dpsim_run_info filled{};
        filled.slaves = static_cast<std::uint32_t>(run->scenario.slaves.size());
        filled.name = run->scenario.name.c_str();
        filled.kind = run->scenario.kind->name();
        filled.end = static_cast<std::uint64_t>(run->scenario.end);
        capi::give(filled, info, "info");
      });
}

dpsim_status dpsim_run_slave(const dpsim_run* run, size_t slave, const char** name) {
  return guarded(
      __func__,
      [&] {
        need(run, "run");
        need(name, "name");
        if (slave >= run->scenario.slaves.size())
          fail(DPSIM_ERR_NOT_FOUND, "the scenario has no slave " + std::to_string(slave) + ", it has " +
                                        std::to_string(run->scenario.slaves.size()));
        *name = run->scenario.slaves[slave].name.text.c_str();
      });
}

dpsim_status dpsim_run_on_change(dpsim_run* run, dpsim_change_fn fn, void* user) {
  return guarded(
      __func__, [&] { open_of(run).watch.on_change(fn, user); });
}

dpsim_status dpsim_run_on_telegram(dpsim_run* run, dpsim_telegram_fn fn, void* user) {
  return guarded(
      __func__, [&] { open_of(run).watch.on_telegram(fn, user); });
}

dpsim_status dpsim_run_on_event(dpsim_run* run, dpsim_chip_event_fn fn, void* user) {
  return guarded(
      __func__, [&] { open_of(run).watch.on_event(fn, user); });
}

dpsim_status dpsim_run_on_text(dpsim_run* run, dpsim_text_fn fn, void* user) {
  return guarded(
      __func__,
      [&] {
        dpsim_run& own = open_of(run);
        own.options.on_text = nullptr;
        if (fn == nullptr) return;
        own.options.on_text = [&own, fn, user](const std::string& station, const std::string& line) {
          fn(user, own.watch.slave_of(station), line.c_str());
        };
      });
}

dpsim_status dpsim_run_keep(dpsim_run* run, uint32_t what) {
  return guarded(
      __func__,
      [&] {
        capi::need_range("what", what, 0, DPSIM_KEEP_CHANGES | DPSIM_KEEP_TELEGRAMS);
        open_of(run).watch.keep(what);
      });
}

dpsim_status dpsim_run_execute(dpsim_run* run, dpsim_poll_fn poll, void* user) {
  return guarded(
      __func__,
      [&] {
        dpsim_run& own = open_of(run);
        own.begun = true;
        const auto bench = make_bench(own);
        own.result = bench->run(
            [&](tb::Tick now) { return poll == nullptr || poll(user, static_cast<std::uint64_t>(now)) != 0; });
        own.watch.check();
      });
}

dpsim_status dpsim_run_get_summary(const dpsim_run* run, dpsim_run_summary* summary) {
  return guarded(
      __func__, [&] { capi::give(summary_of(result_of(run)), summary, "summary"); });
}

dpsim_status dpsim_run_verdict(dpsim_run* run, int32_t* exit_code, const char** text) {
  return guarded(
      __func__,
      [&] {
        need(exit_code, "exit_code");
        need(text, "text");
        const tb::RunResult& result = result_of(run);
        run->verdict = tb::words(result);
        *text = run->verdict.c_str();
        *exit_code = tb::exit_code(tb::verdict(result));
      });
}

dpsim_status dpsim_run_result(dpsim_run* run, const char** json) {
  return guarded(
      __func__,
      [&] {
        need(json, "json");
        if (result_of(run); run->json.empty()) run->json = tb::result_json(*run->result);
        *json = run->json.c_str();
      });
}

dpsim_status dpsim_run_report(dpsim_run* run, const char** text) {
  return guarded(
      __func__,
      [&] {
        need(text, "text");
        if (result_of(run); run->report.empty()) run->report = tb::summary(*run->result);
        *text = run->report.c_str();
      });
}

dpsim_status dpsim_run_read_changes(dpsim_run* run, dpsim_change* changes, size_t capacity, size_t* count) {
  return guarded(
      __func__,
      [&] {
        result_of(run);
        capi::read_changes(run->watch.changes(), changes, capacity, count);
      });
}

dpsim_status dpsim_run_telegrams(const dpsim_run* run, const dpsim_heard** heard, size_t* count) {
  return guarded(
      __func__,
      [&] {
        result_of(run);
        need(heard, "heard");
        need(count, "count");
        *heard = run->watch.telegrams().data();
        *count = run->watch.telegrams().size();
      });
}

#include "apps/options/saved_runs.hpp"

#include <fmt/format.h>

#include <iostream>

#include "apps/options/words.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "io/input/units.hpp"
#include "io/output/output_place.hpp"
#include "lab/campaign/fingerprint.hpp"
#include "tb/scenario/settings.hpp"

namespace dsdpv1::app {
namespace {

std::string this_program() { return tb::campaign::program_identity(DSDPV1_VERSION); }

/// Means the same wherever the run is restored.
std::string kept(const std::string& text) {
  const tb::scenario::Setting setting = tb::scenario::parse_setting("--set", text);
  const bool file = tb::scenario::field_of_any(setting.path, setting.origin).type.kind == tb::keys::Kind::kFile;
  return setting.path + "=" + (file ? tb::scenario::given_path(setting.value) : setting.value);
}

tb::Tick time_in_run(const std::string& text, tb::Tick end) {
  const tb::Tick time = time_of("dsdpv1-sim run: --save-at", text);
  if (time > end)
    throw tb::InputError(fmt::format("dsdpv1-sim run: --save-at is {}, expected a time up to the end of the run, {}",
                                     text, tb::time_text(end)));
  return time;
}

/// By the pins of cores: their pins can be followed from any time on.
bool is_of_cores(const tb::RunOptions& options) {
  return options.view_name == "pins" && (options.engine_name == "step" || options.engine_name == "skip");
}

}  // namespace

tb::SavedRun described_run(const RunArguments& arguments, const std::string& text,
                           const tb::scenario::Scenario& scenario) {
  tb::SavedRun run;
  if (arguments.save_at.empty()) return run;
  run.program = this_program();
  run.scenario = arguments.scenario;
  for (const std::string& setting : arguments.set) run.settings.push_back(kept(setting));
  run.engine = arguments.engine;
  run.view = arguments.view;
  run.checks = arguments.checks;
  run.fault = arguments.fault;
  run.seed = arguments.seed;
  run.files.push_back({arguments.scenario, text});
  for (const std::string& file : scenario.files)
    run.files.push_back({file, tb::read_file(file, {"a file of the scenario", tb::kFirmwareFile.most_mb})});
  return run;
}

void provide_files(const tb::SavedRun& run, const std::string& path) {
  for (const tb::SavedFile& file : run.files) {
    tb::provide_file(file.path, file.content);
    if (!tb::input_identity(file.path)) continue;  // absent, or a pipe that is gone
    if (tb::try_read_file(file.path, tb::kSavedRunFile.most_mb).text == file.content) continue;
    throw tb::InputError(
        file.path, 0, fmt::format("has changed since {} was saved, expected what it was then, or no such file", path));
  }
}

RunArguments arguments_of(RunArguments arguments, const tb::SavedRun& run) {
  arguments.scenario = run.scenario;
  arguments.set = run.settings;
  arguments.engine = run.engine;
  arguments.view = run.view;
  arguments.checks = run.checks;
  arguments.fault = run.fault;
  arguments.seed = run.seed;
  return arguments;
}

void replay_debugger(tb::RunOptions& options, const tb::SavedRun& run) {
  if (!options.gdb && run.inputs.empty()) return;
  if (!options.gdb) options.gdb = tb::GdbRequest{{}, {}, {}, std::make_shared<user_cpu::DebugHistory>()};
  options.gdb->history->inputs = run.inputs;
  options.gdb->history->live_from = run.at;
}

std::vector<NamedFile> save_files(const RunArguments& arguments) {
  std::vector<NamedFile> files;
  for (const auto& [time, file] : arguments.save_at) files.push_back({"--save-at " + time, file});
  return files;
}

SavedRuns::SavedRuns(const RunArguments& arguments, const tb::SavedRun& run, const tb::SavedRun* restored, tb::Tick end)
    : run_(run), restored_(restored), end_(end), path_(arguments.restore) {
  for (const auto& [time, file] : arguments.save_at)
    saves_.push_back(std::make_unique<Save>(time_in_run(time, end), time, file));
}

void SavedRuns::ask(tb::RunOptions& options) {
  for (const auto& save : saves_) options.marks.push_back(save->at);
  if (restored_ != nullptr) {
    options.marks.push_back(restored_->at);
    options.from = restored_->at;
    options.wave.selection.from = std::max(options.wave.selection.from, restored_->at);
    options.wave.asleep =
        is_of_cores(options) && options.wave.selection.from <= end_ && options.wave.on.empty() && !options.wave.inside;
  }
  if (options.gdb) history_ = options.gdb->history;
  options.on_mark = [this](tb::Tick now, std::uint64_t digest) { return marked(now, digest); };
}

/// True if the run continues.
bool SavedRuns::marked(tb::Tick now, std::uint64_t digest) {
  if (restored_ != nullptr && restored_->at == now) {
    met_ = true;
    differs_ = digest != restored_->digest;
    if (differs_) return false;
  }
  try {
    for (const auto& save : saves_)
      if (save->at == now) write(*save, digest);
  } catch (const tb::InputError&) {
    error_ = std::current_exception();
  }
  return !error_;
}

void SavedRuns::write(Save& save, std::uint64_t digest) {
  tb::SavedRun run = run_;
  run.at = save.at;
  run.digest = digest;
  if (history_) run.inputs = history_->inputs;
  save.file.write(tb::to_bytes(run));
  save.file.commit();
  save.time.clear();
}

void SavedRuns::check(bool interrupted) {
  if (error_) std::rethrow_exception(error_);
  if (restored_ != nullptr && (differs_ || (!met_ && !interrupted))) refuse();
  for (const auto& save : saves_)
    if (!save->time.empty())
      std::cerr << fmt::format("dsdpv1-sim: {} is not written: the run was over before {}", save->file.path(),
                               save->time)
                << '\n';
}

void SavedRuns::refuse() const {
  const bool same = restored_->program == this_program();
  throw tb::InputError(path_, 0,
                       fmt::format("the run up to {} is not the one that was saved: {}", tb::time_text(restored_->at),
                                   same ? "this same program does otherwise here, which is its fault"
                                        : fmt::format("{} saved it, this is {}, expected a program that does the same",
                                                      restored_->program, this_program())));
}

}  // namespace dsdpv1::app

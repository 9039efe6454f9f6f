#pragma once
// run --save-at and --restore.
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/options/outputs.hpp"
#include "apps/options/run_arguments.hpp"
#include "io/output/output_file.hpp"
#include "tb/bench/bench.hpp"
#include "tb/saved/saved_run.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::app {

/// A run to save, without its tick and digest: its arguments, and the files that it reads.
tb::SavedRun described_run(const RunArguments& arguments, const std::string& text,
                           const tb::scenario::Scenario& scenario);

/// Provides the saved run's files to all that read them, if absent. Throws tb::InputError for a file that has changed.
void provide_files(const tb::SavedRun& run, const std::string& path);
/// The arguments, with those of a saved run in their place.
RunArguments arguments_of(RunArguments arguments, const tb::SavedRun& run);

/// Repeats the debugger's actions of the saved run; a debugger of this run acts after them.
void replay_debugger(tb::RunOptions& options, const tb::SavedRun& run);

/// The actions of --save-at and --restore during a run.
class SavedRuns {
 public:
  /// Opens the files of --save-at; throws tb::InputError, also for times after the run's end. `restored` may be null;
  /// `run` and `restored` must outlive it.
  SavedRuns(const RunArguments& arguments, const tb::SavedRun& run, const tb::SavedRun* restored, tb::Tick end);

  /// Adds to `options` what the bench has to do at these times.
  void ask(tb::RunOptions& options);
  /// At the end of a run: throws tb::InputError when a file could not be written or the restored run is another one.
  /// Reports files that were not written because the run ended before their time.
  void check(bool interrupted);

 private:
  struct Save {
    Save(tb::Tick tick, std::string text, const std::string& path) : at(tick), time(std::move(text)), file(path) {}
    tb::Tick at;
    std::string time;  ///< as given; empty: the file has been written
    tb::OutputFile file;
  };
  bool marked(tb::Tick now, std::uint64_t digest);
  void write(Save& save, std::uint64_t digest);
  void refuse() const;

  const tb::SavedRun& run_;
  const tb::SavedRun* restored_;
  tb::Tick end_;
  std::string path_;  ///< of --restore
  std::vector<std::unique_ptr<Save>> saves_;
  std::shared_ptr<const user_cpu::DebugHistory> history_;
  bool met_ = false, differs_ = false;
  std::exception_ptr error_;
};

/// The files of --save-at, for check_outputs.
std::vector<NamedFile> save_files(const RunArguments& arguments);

}  // namespace dsdpv1::app

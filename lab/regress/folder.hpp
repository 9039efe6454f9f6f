#pragma once
// The folder of a regression: runs/NAME.json is the result of a run, runs/NAME.info what it has reached of the RTL,
// runs/NAME/ has its kept files, index.html shows all runs.
#include <optional>
#include <string>
#include <vector>

#include "lab/campaign/children.hpp"
#include "lab/campaign/folder.hpp"
#include "lab/regress/outcome.hpp"
#include "lab/regress/plan.hpp"

namespace dsdpv1::tb::regress {

const campaign::Kind& kind();

/// In the folder of a run that did not pass: `sh again.sh` repeats it, of random cases and stimuli by the shortened
/// one.
constexpr const char* kAgain = "again.sh";

/// Coverage of RTL and rulings by all runs together: lcov's tracefiles, and tables.
constexpr const char* kCoverageInfo = "coverage.info";
constexpr const char* kCoverageTable = "coverage.tsv";
constexpr const char* kNotReached = "not_reached.tsv";
constexpr const char* kRulingsInfo = "rulings.info";
constexpr const char* kRulingsTable = "rulings.tsv";

/// The runs whose files are kept.
enum class Keep : std::uint8_t { kNone, kFailed, kAll };
/// "none", "failed", "all", and back.
const std::vector<std::string>& keep_words();
std::optional<Keep> keep_named(const std::string& word);

/// The content of regression.json: the runs and their options.
struct Description {
  Plan plan;
  std::string checks, wave;  ///< of run --checks; "vcd", "fst"; empty: the default, none
  Keep keep = Keep::kFailed;
  bool report = false;  ///< write each run's page (run --report)
  OwnRtl rtl;
  std::string program = {};  ///< version and fingerprint
  bool coverage = false;     ///< runs of the RTL count which lines, branches and toggles of it they reach

  /// Arguments of this program that carry it out.
  std::vector<std::string> words(const Run& run) const;
};
campaign::Json json_of(const Description& description);
/// The description of the last regression in a folder. Throws InputError when none is there.
Description last_description(const std::string& folder);

class Folder {
 public:
  Folder(const std::string& path, const Description& description, campaign::Folder::Access access);

  const campaign::Folder& base() const { return folder_; }
  /// The folder of a run in progress; removed by `finish` or `forget`.
  std::string place(const Run& run) const;
  /// Arguments that make a run write to its folder.
  std::vector<std::string> words(const Run& run) const;

  /// The run's result; nullopt when it is unknown. `key`: the fingerprint of its inputs; empty: any.
  std::optional<Outcome> finished(const Run& run, const std::string& key) const;
  /// Stores the run's result, and its files when they are wanted. Throws InputError when it cannot be written.
  Outcome finish(const Run& run, const std::string& key, const campaign::Ended& ended) const;
  /// seen_of a finished run; null: there is nothing.
  campaign::Json seen(const Run& run) const;
  /// The tracefile of coverage of a finished run; it need not be there.
  std::string counts(const Run& run) const { return folder_.item_file(run.file_name() + ".info"); }
  /// Removes the files of a run in progress.
  void forget(const Run& run) const;
  /// Removes the run's result.
  void remove(const Run& run) const;

 private:
  void write_again(const Run& run, bool differs) const;
  void keep_counts(const Run& run) const;
  void keep_files(const Run& run, Outcome& outcome) const;

  Description description_;
  campaign::Folder folder_;
};

}  // namespace dsdpv1::tb::regress

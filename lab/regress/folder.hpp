#pragma once
// The folder of a regression: runs/NAME.json is what a run has come to, runs/NAME/ what was kept of it, index.html all.
#include <optional>
#include <string>
#include <vector>

#include "lab/campaign/children.hpp"
#include "lab/campaign/folder.hpp"
#include "lab/regress/outcome.hpp"
#include "lab/regress/plan.hpp"

namespace dsdpv1::tb::regress {

const campaign::Kind& kind();

/// Of which runs files are kept.
enum class Keep : std::uint8_t { kNone, kFailed, kAll };
/// "none", "failed", "all", and back.
const std::vector<std::string>& keep_words();
std::optional<Keep> keep_named(const std::string& word);

/// What regression.json says: the runs and how they are carried out.
struct Description {
  Plan plan;
  std::string checks, wave;  ///< of run --checks; "vcd", "fst"; empty: as usual, none
  Keep keep = Keep::kFailed;
  bool report = false;  ///< of each run the page of run --report
};
campaign::Json json_of(const Description& description);
/// That of the last regression in a folder. Throws InputError when there is none.
Description last_description(const std::string& folder);

class Folder {
 public:
  Folder(const std::string& path, const Description& description, campaign::Folder::Access access);

  const campaign::Folder& base() const { return folder_; }
  /// Where a run under way writes; removed by `finish` or `forget`.
  std::string place(const Run& run) const;
  /// Arguments of a run: what it writes goes to its place.
  std::vector<std::string> words(const Run& run) const;

  /// What the run has come to; nullopt when it is not known. `key`: what it depends on; empty: whatever that was.
  std::optional<Outcome> finished(const Run& run, const std::string& key) const;
  /// Keeps what the run has come to, and its files when they are wanted. Throws InputError when it cannot be written.
  Outcome finish(const Run& run, const std::string& key, const campaign::Ended& ended) const;
  /// Removes what is under way.
  void forget(const Run& run) const;
  /// Removes what is known of it.
  void remove(const Run& run) const;

 private:
  void keep_files(const Run& run, Outcome& outcome) const;

  Description description_;
  campaign::Folder folder_;
};

}  // namespace dsdpv1::tb::regress

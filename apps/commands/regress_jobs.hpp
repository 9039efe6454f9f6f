#pragma once
// The runs of a regression as runs of this program.
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lab/campaign/contents.hpp"
#include "lab/campaign/jobs.hpp"
#include "lab/regress/folder.hpp"

namespace dsdpv1::app {

/// The files that each run reads, and what it depends on.
class RegressInputs {
 public:
  /// Reads all of them. Throws InputError for a file that can be read only once.
  RegressInputs(const tb::regress::Description& description, const std::string& program);
  const tb::campaign::Contents& contents() const { return contents_; }
  /// A fingerprint of program, files and words of a run.
  const std::string& key(std::size_t run) const { return keys_[run]; }
  tb::campaign::Contents::Times look(std::size_t run) const { return contents_.look(files_[run]); }

 private:
  tb::campaign::Contents contents_;
  std::vector<std::vector<std::string>> files_;
  std::vector<std::string> keys_;
};

class RegressJobs : public tb::campaign::Jobs {
 public:
  /// `anyhow`: what is known of a run counts whatever it depended on (--failed).
  RegressJobs(const tb::regress::Plan& plan, const RegressInputs& inputs, const tb::regress::Folder& folder,
              bool anyhow);

  std::size_t size() const override { return outcomes_.size(); }
  bool finished(std::size_t job) const override { return outcomes_[job].has_value(); }
  bool look(std::size_t job) override;
  std::vector<std::string> begin(std::size_t job) override;
  std::string end(const tb::campaign::Ended& ended) override;
  void forget(std::size_t job) override;
  std::string name(std::size_t job) const override;

  /// Of all runs, when all are finished.
  std::vector<tb::regress::Outcome> outcomes() const;

 private:
  const tb::regress::Plan& plan_;
  const RegressInputs& inputs_;
  const tb::regress::Folder& folder_;
  bool anyhow_;
  std::vector<std::optional<tb::regress::Outcome>> outcomes_;
  std::map<std::size_t, tb::campaign::Contents::Times> read_;  ///< of the runs under way: their files when they began
};

}  // namespace dsdpv1::app

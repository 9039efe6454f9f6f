#pragma once
// The jobs of a campaign as tasks of a Slurm cluster, judged by the files in the folder.
#include <chrono>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "lab/campaign/jobs.hpp"
#include "lab/campaign/runner.hpp"
#include "lab/campaign/slurm.hpp"

namespace dsdpv1::tb::campaign {

struct OnCluster {
  std::string identity;              ///< tasks of another one are cancelled
  std::string options;               ///< for sbatch
  std::vector<std::string> command;  ///< this program's command line, which a task repeats with --slurm-task
};

/// Submits jobs that are neither finished nor running, and waits for them. Tasks of an earlier process continue and are
/// waited for. A task that ends without a result is submitted once more.
class SlurmRunner {
 public:
  SlurmRunner(Jobs& jobs, const Folder& folder, Carrying carrying, OnCluster cluster);

  /// False when it was interrupted; then the tasks are cancelled. Throws InputError when Slurm refuses the tasks, or
  /// one has twice ended without a result; the other tasks then continue.
  bool run();

  std::size_t done() const { return done_; }

 private:
  using Clock = std::chrono::steady_clock;
  void take_over();
  void wait_for_all();
  void collect();
  void ask();
  void submit_missing();
  std::vector<std::size_t> gone() const;
  void check_tries(std::size_t job) const;
  void end_all();

  Jobs& jobs_;
  const Folder& folder_;
  Carrying carrying_;
  OnCluster cluster_;
  Slurm slurm_;
  CountProgress bar_;
  std::vector<Submission> submissions_;
  std::set<std::size_t> missing_;    ///< jobs without a result
  std::set<std::size_t> under_way_;  ///< jobs of tasks that wait or run
  std::set<std::size_t> not_seen_;   ///< jobs that were in neither at the last question to Slurm
  std::map<std::size_t, int> tries_;
  std::size_t done_;
};

}  // namespace dsdpv1::tb::campaign

#pragma once
// The jobs of a campaign in child processes.
#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "lab/campaign/children.hpp"
#include "lab/campaign/folder.hpp"
#include "lab/campaign/jobs.hpp"
#include "tb/report/progress.hpp"

namespace dsdpv1::tb::campaign {

/// Options for running jobs.
struct Carrying {
  Kind kind;
  unsigned at_a_time = 1;                  ///< processes
  std::optional<Children::Seconds> limit;  ///< of a run
  bool progress = false;                   ///< show a bar
  std::function<bool()> interrupted;       ///< asked often
};

/// Runs unfinished jobs.
class Runner {
 public:
  Runner(Jobs& jobs, Carrying carrying);
  /// The same for some of the jobs.
  Runner(Jobs& jobs, Carrying carrying, const std::vector<std::size_t>& wanted);
  ~Runner() { give_up(); }
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  /// False when it was interrupted. Throws InputError when an input has changed, a job cannot be kept, or its run has
  /// twice ended without a result.
  bool run();

  std::size_t done() const { return done_; }

 private:
  void run_missing();
  bool start_next();
  void take(const Ended& ended);
  void try_again(const Ended& ended, const std::string& why);
  void give_up();

  Jobs& jobs_;
  Carrying carrying_;
  CountProgress bar_;
  Children children_;
  std::vector<bool> tried_;
  std::deque<std::size_t> waiting_;  ///< neither finished nor running
  std::size_t all_ = 0, done_ = 0;
};

std::vector<std::size_t> all_of(const Jobs& jobs);
/// How many are finished.
std::size_t count_finished(const Jobs& jobs);

}  // namespace dsdpv1::tb::campaign

#pragma once
// The points of a sweep in child processes.
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tb/report/progress.hpp"
#include "tb/sweep/children.hpp"
#include "tb/sweep/folder.hpp"
#include "tb/sweep/inputs.hpp"
#include "tb/sweep/plan.hpp"
#include "tb/sweep/point.hpp"

namespace app {

/// Runs what is not finished yet, `jobs` points at a time.
class SweepRunner {
 public:
  SweepRunner(const tb::sweep::Plan& plan, const tb::sweep::Inputs& inputs, const tb::sweep::Folder& folder,
              unsigned jobs, bool progress);
  ~SweepRunner() { give_up(); }
  SweepRunner(const SweepRunner&) = delete;
  SweepRunner& operator=(const SweepRunner&) = delete;

  /// False when it was interrupted. Throws InputError when an input has changed, a point cannot be kept, or its run has
  /// twice ended without a statement about the point.
  bool run();

  std::size_t done() const { return done_; }
  std::size_t kept() const { return kept_; }
  std::vector<tb::sweep::Point> points() const;

 private:
  void run_missing();
  bool start_next();
  std::vector<std::string> arguments(std::size_t point) const;
  void take(tb::sweep::Ended ended);
  std::optional<tb::sweep::Point> told(tb::sweep::Ended& ended) const;
  void try_again(const tb::sweep::Ended& ended);
  std::string name_of(std::size_t point) const;
  void give_up();

  const tb::sweep::Plan& plan_;
  const tb::sweep::Inputs& inputs_;
  const tb::sweep::Folder& folder_;
  unsigned jobs_;
  tb::CountProgress bar_;
  tb::sweep::Children children_;
  std::vector<std::optional<tb::sweep::Point>> points_;
  std::map<std::size_t, tb::sweep::Inputs::Times> read_;  ///< of the runs under way: their files when they began
  std::vector<bool> tried_;
  std::size_t done_ = 0, kept_ = 0, next_ = 0;
};

}  // namespace app

#pragma once
// The points of a sweep as runs of this program.
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lab/campaign/jobs.hpp"
#include "lab/sweep/folder.hpp"
#include "lab/sweep/inputs.hpp"
#include "lab/sweep/plan.hpp"
#include "lab/sweep/point.hpp"

namespace dsdpv1::app {

class SweepJobs : public tb::campaign::Jobs {
 public:
  SweepJobs(const tb::sweep::Plan& plan, const tb::sweep::Inputs& inputs, const tb::sweep::Folder& folder);

  std::size_t size() const override { return points_.size(); }
  bool finished(std::size_t job) const override { return points_[job].has_value(); }
  bool look(std::size_t job) override;
  std::vector<std::string> begin(std::size_t job) override;
  std::string end(const tb::campaign::Ended& ended) override;
  void forget(std::size_t job) override;
  std::string name(std::size_t job) const override;

  /// Of all points, when all are finished.
  std::vector<tb::sweep::Point> points() const;

 private:
  const tb::sweep::Plan& plan_;
  const tb::sweep::Inputs& inputs_;
  const tb::sweep::Folder& folder_;
  std::vector<std::optional<tb::sweep::Point>> points_;
  std::map<std::size_t, tb::sweep::Inputs::Times> read_;  ///< of the runs under way: their files when they began
};

}  // namespace dsdpv1::app

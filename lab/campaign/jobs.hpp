#pragma once
// The jobs of a campaign, for local processes or the tasks of a cluster.
#include <cstddef>
#include <string>
#include <vector>

#include "lab/campaign/children.hpp"

namespace dsdpv1::tb::campaign {

class Jobs {
 public:
  Jobs() = default;
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;
  virtual ~Jobs() = default;

  virtual std::size_t size() const = 0;
  /// True when the folder had the job's result at the last check.
  virtual bool finished(std::size_t job) const = 0;
  /// Checks the folder: an earlier process, or a task of a cluster, may have finished the job. True when it is
  /// finished.
  virtual bool look(std::size_t job) = 0;
  /// A run of this program begins; returns its arguments.
  virtual std::vector<std::string> begin(std::size_t job) = 0;
  /// The run has ended: stores its result, which finishes the job. Otherwise returns the reason why there is no result;
  /// another try may give one.
  virtual std::string end(const Ended& ended) = 0;
  /// The run was ended without a result.
  virtual void forget(std::size_t job) = 0;
  /// "point 3 (datast=4)".
  virtual std::string name(std::size_t job) const = 0;
};

/// A short reason why a run has no result.
std::string fate(const Ended& ended);

}  // namespace dsdpv1::tb::campaign

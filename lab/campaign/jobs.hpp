#pragma once
// What a campaign runs, whoever carries it out: processes here, or the tasks of a cluster.
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
  /// Whether the folder had what the job has shown when it was looked at last.
  virtual bool finished(std::size_t job) const = 0;
  /// Looks into the folder: an earlier process, or a task of a cluster, may have finished it. True when it is finished.
  virtual bool look(std::size_t job) = 0;
  /// A run of this program begins; returns its arguments.
  virtual std::vector<std::string> begin(std::size_t job) = 0;
  /// It has ended: keeps what it says about the job, which is finished then. Otherwise returns why it says nothing, and
  /// another try may.
  virtual std::string end(const Ended& ended) = 0;
  /// It was ended before it could say anything.
  virtual void forget(std::size_t job) = 0;
  /// "point 3 (datast=4)".
  virtual std::string name(std::size_t job) const = 0;
};

/// In a few words why a run has no result.
std::string fate(const Ended& ended);

}  // namespace dsdpv1::tb::campaign

#pragma once
// Runs of this program in child processes.
#include <sys/types.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tb::sweep {

/// A run that has come to its end.
struct Ended {
  std::size_t point = 0;
  int exit = 0;      ///< 128 + signal when it was killed, 127 when it could not be started
  std::string said;  ///< the last line of its error channel
};

/// The process has no other children than these, and no other threads. They end with it, also when it is killed.
class Children {
 public:
  Children() = default;
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;
  /// Ends those that still run.
  ~Children();

  /// Starts this program with `arguments`; it writes nothing but its error channel. One that the system does not start
  /// has ended at once.
  void start(std::size_t point, const std::vector<std::string>& arguments);
  std::size_t running() const { return runs_.size() + not_started_.size(); }
  /// One that has ended; waits a moment when there is none, and returns nullopt then, so that the caller hears signals.
  std::optional<Ended> wait();
  /// Asks all to end.
  void terminate() const;

 private:
  struct Run {
    std::size_t point = 0;
    int errors = -1;  ///< file in memory: a full disk does not silence the run
  };
  std::map<pid_t, Run> runs_;
  std::vector<Ended> not_started_;
};

}  // namespace tb::sweep

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
  int exit = 0;  ///< 128 + signal when it was killed
};

/// The process has no other children than these.
class Children {
 public:
  Children() = default;
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;
  /// Ends those that still run.
  ~Children();

  /// Starts this program with `arguments`; it writes nothing but its error channel, into `errors`. Throws InputError when the
  /// system refuses.
  void start(std::size_t point, const std::vector<std::string>& arguments, const std::string& errors);
  std::size_t running() const { return points_.size(); }
  /// One that has ended; waits a moment when there is none, and returns nullopt then, so that the caller hears signals.
  std::optional<Ended> wait();
  /// Asks all to end.
  void terminate() const;

 private:
  std::map<pid_t, std::size_t> points_;
};

}  // namespace tb::sweep

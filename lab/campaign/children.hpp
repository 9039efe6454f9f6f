#pragma once
// Runs of this program in child processes.
#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dsdpv1::tb::campaign {

/// Exit codes of a run, docs/verdicts.md.
constexpr int kPassed = 0, kFailed = 1, kWrongInput = 2, kNothingJudged = 3;
constexpr int kSignalled = 128;  ///< an exit code above it: killed by signal (code - kSignalled)

/// A finished run.
struct Ended {
  std::size_t job = 0;
  int exit = 0;           ///< kSignalled + signal when it was killed, 127 when it could not be started
  std::string output;     ///< the last 4 KB of its output and error channels
  double seconds = 0;     ///< duration
  bool too_long = false;  ///< killed at its time limit

  /// Its last line; a library's warnings come before it.
  std::string last_line() const;
};

/// The process has no other children than these, and no other threads. They end with it, also when it is killed.
class Children {
 public:
  using Seconds = std::chrono::duration<double>;

  Children() = default;
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;
  /// Ends those that still run.
  ~Children();

  /// Starts this program with `arguments`; it writes nothing but its channels. A run that the system cannot start ends
  /// at once. After `limit` it is killed.
  void start(std::size_t job, const std::vector<std::string>& arguments, std::optional<Seconds> limit = std::nullopt);
  std::size_t running() const { return runs_.size() + not_started_.size(); }
  /// A run that has ended. If there is none, waits a moment and returns nullopt, so that the caller can handle signals.
  std::optional<Ended> wait();
  /// Asks all to end.
  void terminate() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Run {
    std::size_t job = 0;
    int output = -1;  ///< file in memory: so a full disk does not lose its messages
    Clock::time_point begin;
    std::optional<Seconds> limit;
    bool too_long = false;
  };
  void kill_the_late();
  static Ended ended(const Run& run, int status);

  std::map<pid_t, Run> runs_;
  std::vector<Ended> not_started_;
};

}  // namespace dsdpv1::tb::campaign

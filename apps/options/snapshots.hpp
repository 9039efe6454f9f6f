#pragma once
// Waiting copies of this process, from which it can continue again: made by fork, so unchanged memory exists once.
// One thread only.
#include <sys/types.h>

#include <optional>
#include <vector>

#include "bus/time.hpp"
#include "io/input/descriptor.hpp"

namespace dsdpv1::app {

/// A window of simulated time, both ends in it.
struct Window {
  bus::Tick from = 0, to = 0;
};

class Snapshots {
 public:
  Snapshots() = default;
  /// Ends those that wait. A process that gets killed takes them with it.
  ~Snapshots() { clear(); }
  Snapshots(const Snapshots&) = delete;
  Snapshots& operator=(const Snapshots&) = delete;

  /// Returns at once in this process, without a value; in a copy, when it is woken, what it is woken for. False by
  /// `possible` from then on when the system allows no further process.
  std::optional<Window> take(bus::Tick now);
  bool possible() const { return possible_; }

  bool empty() const { return all_.empty(); }
  bus::Tick newest() const { return all_.back().at; }
  /// Only the newest one taken up to `at` is needed.
  void forget_before(bus::Tick at);
  /// Continues the newest one taken up to `at` and waits for its end: its exit code, -1 when it was killed.
  int wake(bus::Tick at, const Window& window);
  void clear();

 private:
  struct Copy {
    pid_t process;
    tb::Descriptor order;  ///< pipe to it
    bus::Tick at;
  };
  static void end(const Copy& copy);

  std::vector<Copy> all_;  ///< in order of time
  bool possible_ = true;
};

}  // namespace dsdpv1::app

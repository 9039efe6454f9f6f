#pragma once
// Copies of this process that wait, so that it can go on from there once more: by fork, so what they do not change is
// in memory once. One thread only.
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
  /// Of those taken up to `at` only the newest is needed.
  void forget_before(bus::Tick at);
  /// Lets the newest that was taken up to `at` go on, and waits for its end: its exit code, -1 when it was killed.
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

#pragma once
// Compares two waves in order of time, each read once from front to back.
#include <functional>
#include <queue>

#include "lab/compare/both_wave.hpp"
#include "lab/compare/levels.hpp"
#include "lab/compare/masks.hpp"
#include "lab/compare/result.hpp"
#include "lab/compare/side.hpp"
#include "lab/compare/watchers.hpp"

namespace dsdpv1::tb::compare {

class Comparison {
 public:
  /// Reads the declarations of both files and finds the pairs. Throws InputError.
  Comparison(const std::string& a, const std::string& b, Options options, const MakeSurroundings& make = {});

  Comparison(const Comparison&) = delete;
  Comparison& operator=(const Comparison&) = delete;

  /// Call before `run`: also writes all compared signals into this wave.
  void write_wave(const std::string& path) { wave_.emplace(path, pairs_.pairs); }
  /// Called repeatedly while it runs, with the part of the files that has been read, 0 to 1.
  void on_progress(std::function<void(double)> progress) { progress_ = std::move(progress); }

  /// Throws InputError when a file is damaged, or too little was compared for a difference to show.
  Result run();

 private:
  /// The result of a pair.
  struct State {
    bool differs = false;
    std::uint32_t times = 0;  ///< how often it began to differ
    Time since = 0;
    Time tolerance = 0;
    Difference began;
  };
  /// A pair that began to differ, until the tolerance has passed.
  struct Open {
    Time deadline;  ///< end of the tolerance; at once without one
    std::uint32_t pair, times;
    bool operator>(const Open& other) const { return deadline > other.deadline; }
  };

  void start();
  void check_window() const;
  void go_by_changes();
  void go_by_clock();
  std::optional<Time> next_change() const;
  bool passed(Time time) const;
  void compare_at(Time now);
  void compare(std::uint32_t pair, Time now);
  void begins_to_differ(std::uint32_t pair, Time now, std::string_view a, std::string_view b);
  void confirm_until(Time now);
  void confirm(std::uint32_t pair, Time now);
  Time tolerance() const;
  bool b_ends_first() const;
  void check_enough() const;
  Result finish();
  void tell_progress();

  Options options_;
  Side a_, b_;
  Pairs pairs_;
  Levels levels_;
  Touched touched_;
  std::vector<std::pair<Probe, Probe>> probes_;
  Masks masks_;
  Watchers watchers_;
  Scale scale_;
  std::vector<State> states_;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
  bool off_ = false;  ///< one of the sides records nothing
  Time from_ = 0, to_ = 0, until_ = 0;
  Result result_;
  std::optional<BothWave> wave_;
  std::function<void(double)> progress_;
  std::uint32_t steps_ = 0;
};

}  // namespace dsdpv1::tb::compare

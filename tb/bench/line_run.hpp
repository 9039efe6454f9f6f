#pragma once
// A run of characters in a wave: nobody tells its changes one by one, so they are made when something behind them is
// written.
#include <cstddef>
#include <vector>

#include "bus/wire/character_run.hpp"

namespace dsdpv1::tb {

class LineRun {
 public:
  /// Its changes, in the place of what is left of the one before.
  void begin(const bus::CharacterRun& run);
  /// What is left does not happen.
  void end() { edges_.clear(), next_ = 0; }
  bool is_under_way() const { return next_ < edges_.size(); }
  /// Of the next change, while the run is under way.
  bus::Tick at() const { return edges_[next_]; }
  bool level() const { return next_ % 2 != 0; }
  void go_on() { ++next_; }

 private:
  std::vector<bus::Tick> edges_;  ///< falling and rising in turn
  std::size_t next_ = 0;
};

}  // namespace dsdpv1::tb

#pragma once
// Automatic baud rate search (ruling S1, APC3 4.4.1): from 12 Mbit/s downwards, wrapping, one window per rate.
#include <algorithm>

#include "model/profibus/baud.hpp"

namespace dsdpv1::profibus {

class BaudSearch {
 public:
  /// Minimum time at one rate: `window` cycles and `bits` bit times.
  BaudSearch(Cycle window, Cycle bits) : window_(window), bits_(bits) {}

  void start(Cycle now) {
    searching_ = true;
    select(BaudIndex::fastest(), now);
  }
  /// The present rate is the right one.
  void lock() {
    searching_ = false;
    deadline_ = kNever;
  }
  /// Processes the clock edge at `now`. Returns true if the window of the present rate has passed and the next rate is
  /// selected.
  bool eval(Cycle now) {
    if (now < deadline_) return false;
    select(index_.next(), now);
    return true;
  }
  Cycle next() const { return deadline_; }

  bool searching() const { return searching_; }
  BaudIndex index() const { return index_; }  ///< the rate that the receiver uses, found or tried
  int bit() const { return index_.bit_cycles(); }
  int max_tsdr() const { return index_.max_tsdr(); }

  template <class Archive>
  void store(Archive& archive) {
    auto& [window, bits, deadline, index, searching] = *this;
    archive.given(window, bits);
    archive.cycles(deadline);
    archive(index, searching);
    archive.check(index_.known());
  }

 private:
  void select(BaudIndex index, Cycle now) {
    index_ = index;
    deadline_ = now + std::max(window_, bits_ * bit());
  }

  Cycle window_, bits_;
  Cycle deadline_ = kNever;
  BaudIndex index_ = BaudIndex::fastest();
  bool searching_ = false;
};

}  // namespace dsdpv1::profibus

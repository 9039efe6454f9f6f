#pragma once
// The watchdog state machine (ruling S1, APC3 4.4.2 and 4.4.3): BAUD_CONTROL monitors that the baud rate is still
// right, DP_CONTROL that the holding master is alive. BAUD_SEARCH is the state without a deadline: see BaudSearch.
#include "model/profibus/baud.hpp"

namespace dsdpv1::profibus {

class Watchdog {
 public:
  enum class State : std::uint8_t { kBaudSearch, kBaudControl, kDpControl };

  explicit Watchdog(Cycle baud_control) : baud_control_(baud_control) {}

  void baud_search() {
    state_ = State::kBaudSearch;
    deadline_ = kNever;
  }
  /// The baud rate was found.
  void rate_found(Cycle now) {
    state_ = State::kBaudControl;
    deadline_ = now + baud_control_;
  }
  /// A Set_Prm without or with watchdog, or the end of one. Ignored during the search.
  void baud_control(Cycle now) {
    if (state_ != State::kBaudSearch) rate_found(now);
  }
  /// The watchdog time of Set_Prm: WD_Fact_1 x WD_Fact_2, and WD_Base, 1 or 10 ms.
  static constexpr Cycle time_of(unsigned factors, unsigned base_ms) { return kCyclesPerMs * base_ms * factors; }
  void dp_control(Cycle now, Cycle time) {
    if (state_ == State::kBaudSearch) return;
    state_ = State::kDpControl;
    time_ = time;
    deadline_ = now + time;
  }
  /// An error-free telegram to this station; `from_holder`: sent by the master that holds the slave (ruling S22).
  void trigger(Cycle now, bool from_holder) {
    if (state_ == State::kBaudControl) deadline_ = now + baud_control_;
    if (state_ == State::kDpControl && from_holder) deadline_ = now + time_;
  }
  bool expired(Cycle now) const { return now >= deadline_; }
  Cycle next() const { return deadline_; }
  State state() const { return state_; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [baud_control, time, deadline, state] = *this;
    archive.given(baud_control);
    archive.lengths(time);
    archive.cycles(deadline);
    archive.within(State::kBaudSearch, State::kDpControl, state);
  }

 private:
  Cycle baud_control_;
  Cycle time_ = 0;
  Cycle deadline_ = kNever;
  State state_ = State::kBaudSearch;
};

}  // namespace dsdpv1::profibus

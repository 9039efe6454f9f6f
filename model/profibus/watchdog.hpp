#pragma once
// The watchdog state machine (ruling S1, APC3 4.4.2 and 4.4.3): BAUD_CONTROL monitors that the baud rate is still
// right, DP_CONTROL that the holding master is alive. BAUD_SEARCH is the state without a deadline: see BaudSearch. A
// watchdog that a verdict starts meanwhile waits for the rate (S29).
#include "model/profibus/baud.hpp"

namespace dsdpv1::profibus {

class Watchdog {
 public:
  enum class State : std::uint8_t { kBaudSearch, kBaudControl, kDpControl };

  explicit Watchdog(Cycle baud_control) : baud_control_(baud_control) {}

  /// The time of BAUD_CONTROL from its next begin or trigger on; kNever: it does not end.
  void set_baud_control(Cycle time) { baud_control_ = time; }
  Cycle baud_control_time() const { return baud_control_; }
  void baud_search() {
    state_ = State::kBaudSearch;
    deadline_ = kNever;
    waits_ = false;
  }
  /// The baud rate was found.
  void rate_found(Cycle now) {
    waits_ ? begin(State::kDpControl, now, time_) : begin(State::kBaudControl, now, baud_control_);
    waits_ = false;
  }
  /// A Set_Prm without watchdog, or the end of one.
  void baud_control(Cycle now) {
    waits_ = false;
    if (state_ != State::kBaudSearch) begin(State::kBaudControl, now, baud_control_);
  }
  /// The watchdog time of Set_Prm: WD_Fact_1 x WD_Fact_2, and WD_Base, 1 or 10 ms.
  static constexpr Cycle time_of(unsigned factors, unsigned base_ms) { return kCyclesPerMs * base_ms * factors; }
  /// A Set_Prm with watchdog.
  void dp_control(Cycle now, Cycle time) {
    time_ = time;
    waits_ = state_ == State::kBaudSearch;
    if (!waits_) begin(State::kDpControl, now, time);
  }
  /// An error-free telegram to this station; `from_holder`: sent by the master that holds the slave (ruling S22).
  void trigger(Cycle now, bool from_holder) {
    if (state_ == State::kBaudControl) deadline_ = after(now, baud_control_);
    if (state_ == State::kDpControl && from_holder) deadline_ = now + time_;
  }
  bool expired(Cycle now) const { return now >= deadline_; }
  Cycle next() const { return deadline_; }
  State state() const { return state_; }

  template <class Archive>
  void store(Archive& archive) {
    auto& [baud_control, time, deadline, state, waits] = *this;
    archive.given(baud_control);
    archive.lengths(time);
    archive.cycles(deadline);
    archive.within(State::kBaudSearch, State::kDpControl, state);
    archive(waits);
  }

 private:
  void begin(State state, Cycle now, Cycle time) {
    state_ = state;
    deadline_ = after(now, time);
  }
  static Cycle after(Cycle now, Cycle time) { return time == kNever ? kNever : now + time; }

  Cycle baud_control_;
  Cycle time_ = 0;
  Cycle deadline_ = kNever;
  State state_ = State::kBaudSearch;
  bool waits_ = false;  ///< time_ runs from the rate on
};

}  // namespace dsdpv1::profibus

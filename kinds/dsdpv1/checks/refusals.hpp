#pragma once
// What the chip refused of what the user wrote (U6). The chip's events tell; without them, as of foreign RTL, nothing
// is judged.
#include <array>

#include "kinds/dsdpv1/checks/check.hpp"
#include "kinds/dsdpv1/checks/user_hold.hpp"
#include "model/profibus/event.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

class Refusals {
 public:
  enum class Port : std::uint8_t { kParallel, kSpi, kUart };

  explicit Refusals(Recorder& recorder) : recorder_(recorder) {}

  /// RESET is low.
  void reset() {
    fetched_ = unfounded_ = {};
    lengths_ = 0;
    cfg_waits_ = false;
  }
  void intr0_fell() { cfg_waits_ = true; }
  /// False until the chip has told something, as when it has started up.
  bool judges() const { return told_; }
  /// `holds` has what the user has read in it.
  void hold(const UserHold& hold, const UserHolds& holds);
  void event(const profibus::Event& event, Port port);

 private:
  bool is_users_fault(const profibus::Event& event, Port port);
  bool is_wrong_length(unsigned length, Port port);

  Recorder& recorder_;
  bool told_ = false;                ///< an event
  std::array<bool, 2> fetched_{};    ///< parameters, configuration: since the last verdict
  std::array<bool, 2> unfounded_{};  ///< the last verdict was on nothing
  unsigned lengths_ = 0;             ///< inputs of another length since the user fetched a configuration
  bool cfg_waits_ = false;           ///< a configuration may: since INTR0 no look has found B00E.2 clear
};

}  // namespace dsdpv1::checks

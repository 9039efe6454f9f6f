#pragma once
// Listener for a stimulus that is played: log and wave.
#include "bus/monitor/monitor.hpp"
#include "cosim/lockstep.hpp"

namespace dsdpv1::cosim {

/// Derived classes override the calls that they need.
class PlayListener {
 public:
  virtual ~PlayListener() = default;
  /// The run begins; all pins have their levels of power-on.
  virtual void begins(const tb::PinDevice& /*both*/) {}
  /// See Lockstep::on_pin.
  virtual void pin(Tick /*at*/, Side /*side*/, PinNumber /*pin*/, Level /*level*/) {}
  /// An event of the model.
  virtual void event(const profibus::Event& /*event*/) {}
  /// A telegram has ended, received at `now`.
  virtual void telegram(Tick /*now*/, const bus::WireTelegram& /*telegram*/) {}
  /// The model was evaluated up to `now`.
  virtual void evaluated(Tick /*now*/, tb::PinDevice& /*model*/) {}
  /// The run has ended.
  virtual void ends(Tick /*end*/, const Lockstep& /*lockstep*/) {}
};

}  // namespace dsdpv1::cosim

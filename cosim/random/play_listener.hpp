#pragma once
// Who hears what happens while a stimulus is played: log and wave.
#include "bus/monitor/monitor.hpp"
#include "cosim/lockstep.hpp"

namespace dsdpv1::cosim {

/// Overrides what concerns it.
class PlayListener {
 public:
  virtual ~PlayListener() = default;
  /// The run begins; all pins have their levels of power-on.
  virtual void begins(const tb::PinDevice& /*both*/) {}
  /// See Lockstep::on_pin.
  virtual void pin(Tick /*at*/, Side /*side*/, PinNumber /*pin*/, Level /*level*/) {}
  /// Of the model.
  virtual void event(const profibus::Event& /*event*/) {}
  /// A telegram has ended, heard at `now`.
  virtual void telegram(Tick /*now*/, const bus::WireTelegram& /*telegram*/) {}
  /// The model was evaluated up to `now`.
  virtual void evaluated(Tick /*now*/, tb::PinDevice& /*model*/) {}
  /// The run is over.
  virtual void ends(Tick /*end*/, const Lockstep& /*lockstep*/) {}
};

}  // namespace dsdpv1::cosim

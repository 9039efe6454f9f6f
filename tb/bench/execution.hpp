#pragma once
// The way a run is executed: makes the chips and advances time.
#include <functional>
#include <memory>
#include <string>

#include "bus/timeline.hpp"
#include "tb/chip/chip_kind.hpp"
#include "tb/chip/chip_view.hpp"

namespace dsdpv1::tb {

class Execution {
 public:
  virtual ~Execution() = default;
  /// By default by the pins of its core. Chips are made before other agents are added to the timeline.
  virtual std::unique_ptr<ChipView> make_chip(const ChipKind& kind, const ChipRequest& request) {
    return add_chip(kind, request, kind.make_device(request));
  }
  /// Runs the timeline up to and including `end`, or until `stopped` returns true.
  virtual void run(Tick end, const std::function<bool()>& stopped) = 0;

  /// True if the execution has ended the run early.
  virtual bool broken_off() { return false; }

  /// As in bus::Timeline; 0 and false: each action has a separate turn.
  virtual Tick quiet_until(const bus::Agent& /*agent*/) { return 0; }
  virtual bool go_on(const bus::Agent& /*agent*/, Tick /*tick*/) { return false; }

  bus::Segment& segment() { return segment_; }
  bus::Timeline& timeline() { return timeline_; }

 protected:
  /// The chip with the pins of `device`.
  std::unique_ptr<ChipView> add_chip(const ChipKind& kind, const ChipRequest& request,
                                     std::unique_ptr<PinDevice> device);

  bus::Segment segment_;
  bus::Timeline timeline_;
};

/// By the pins of the cores, no SystemC.
std::unique_ptr<Execution> make_pin_execution();

}  // namespace dsdpv1::tb

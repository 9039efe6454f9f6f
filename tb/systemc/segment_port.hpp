#pragma once
// Connects the pins of a chip in a SystemC platform, in any view or as RTL, to a PROFIBUS segment as a station.
#include <systemc>

#include "bus/wire/segment.hpp"
#include "tb/systemc/timeline_module.hpp"

namespace dsdpv1::systemc_bench {

/// The RS-485 transceiver between a chip and the segment. The chip's levels are on the line, and the line's levels at
/// PBRXD, at the tick of the change.
class SegmentPort : public sc_core::sc_module, private bus::Listener {
 public:
  sc_core::sc_in<bool> PBTXD{"PBTXD"}, PBRTS{"PBRTS"};  ///< from the chip; PBRTS high enables the driver
  sc_core::sc_out<bool> PBRXD{"PBRXD"};                 ///< to the chip; idle high

  /// Both must outlive the simulation. The masters are agents of `timeline`.
  SegmentPort(const sc_core::sc_module_name& name, bus::Segment& segment, TimelineModule& timeline);

 private:
  void drive();
  void hear() { PBRXD.write(segment_.level_at(station_)); }
  void line_changed(bus::Tick at, bool level) override;

  bus::Segment& segment_;
  TimelineModule& timeline_;
  bus::StationId station_;
  sc_core::sc_event heard_{"heard"};
};

}  // namespace dsdpv1::systemc_bench

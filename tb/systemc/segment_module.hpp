#pragma once
// A PROFIBUS segment in a SystemC platform, at the level of characters: chips in their TLM view, masters and other
// agents, chips by their pins, and a tap for everything heard.
//
//   dsdpv1::systemc_bench::SegmentModule line("line");
//   line.attach(chip);                                   // TlmModule, RsuTlmModule, Spc3TlmModule: any number
//   dsdpv1::bus::Master1 master(line.segment(), config);
//   line.add(master);
//   line.heard.bind(log);                                // tlm_analysis_if<HeardCharacter>
//
// Ports and time: docs/systemc.md.
#include <cstddef>
#include <memory>
#include <optional>
#include <systemc>
#include <vector>

#include "bus/monitor/monitor.hpp"
#include "model/systemc/dsdpv1_tlm.hpp"
#include "model/systemc/spc3_tlm.hpp"
#include "tb/systemc/chip_port.hpp"
#include "tb/systemc/timeline_module.hpp"

namespace dsdpv1::systemc_bench {

/// A character as a receiver on the line samples it, in the middle of each bit.
struct HeardCharacter : dsdpv1::systemc::BusCharacter {
  bool collided = false;  ///< two drivers were enabled during it
};

/// The wire: high unless a station drives low, so two stations at once destroy each other's bits. Each telegram is one
/// event for every chip that needs no more, as long as it is the only one on the line; any other change ends that at
/// its tick. Nothing is delivered late: a station hears a character while it is sent.
class SegmentModule : public sc_core::sc_module {
 public:
  /// Every character on the line, in the middle of its stop bit, by a receiver with the rate of monitor(). Unbound it
  /// costs nothing.
  dsdpv1::systemc::ListenedPort<HeardCharacter> heard{"heard"};

  explicit SegmentModule(const sc_core::sc_module_name& name);

  /// The chip is a station from now on; its ports of the line and `bus_in` may stay unbound. Before the simulation
  /// starts; it sets the functions of LineStation. A second time it is the error /dsdpv1/segment.
  bus::StationId attach(dsdpv1::systemc::TlmModule& chip);
  bus::StationId attach(dsdpv1::systemc::Spc3TlmModule& chip);
  /// A master, monitor or other agent on segment().
  void add(bus::Agent& agent) { timeline_.add(agent); }

  /// The wire, for agents, faults (force, plug) and pins (SegmentPort). Its on_drive is in use.
  bus::Segment& segment() { return segment_; }
  /// For SegmentPort, and to wake agents.
  TimelineModule& agents() { return agents_; }
  /// Decodes all telegrams from its first use on. The rate of the line is 12 Mbit/s until Monitor::set_baud.
  bus::Monitor& monitor();

 private:
  void end_of_elaboration() override;
  bus::StationId attach(const dsdpv1::systemc::TimedModule& module, dsdpv1::systemc::LineStation& chip);
  void driven(bus::StationId station, bus::Tick at, bool enabled);
  void tell(const bus::ReceivedCharacter& character);
  bool collided(bus::Tick start) const;

  bus::Segment segment_;
  bus::Timeline timeline_;
  TimelineModule agents_{"agents", timeline_};
  std::vector<std::unique_ptr<ChipPort>> chips_;
  std::optional<bus::Monitor> monitor_;
  std::vector<bool> enabled_;  ///< by station
  std::size_t drivers_ = 0;    ///< enabled ones
  bus::Tick conflict_end_ = 0;
};

}  // namespace dsdpv1::systemc_bench

#pragma once
// A chip's TLM module as a station of a segment: levels at their ticks, telegrams as a whole while nothing disturbs
// them.
#include <string>

#include "bus/wire/segment.hpp"
#include "model/systemc/core_module.hpp"
#include "model/systemc/line_station.hpp"
#include "tb/systemc/timeline_module.hpp"

namespace dsdpv1::systemc_bench {

/// Sets `on_answer` and `on_left_run` of the chip. Its owner passes the levels of the driver by enable() and drive().
/// The line arrives at the chip at its tick, one delta cycle later, which no rule of the chip can distinguish (P9).
class ChipPort : private bus::Listener {
 public:
  /// `module`: of the chip, for its place in time. All must outlive the simulation.
  ChipPort(const std::string& name, dsdpv1::systemc::LineStation& chip, const dsdpv1::systemc::TimedModule& module,
           bus::Segment& segment, TimelineModule& timeline);
  ChipPort(const ChipPort&) = delete;
  ChipPort& operator=(const ChipPort&) = delete;

  bus::StationId station() const { return station_; }
  /// The chip's pins PBRTS and PBTXD (RTS, TXD) at the chip's tick `at`, now.
  void enable(bus::Tick at, bool enabled);
  void drive(bus::Tick at, bool level);

 private:
  void line_changed(bus::Tick at, bool level) override;
  bool run_begins(const bus::CharacterRun& run) override;
  void run_cut(bus::Tick at, bool level) override;
  bool answer_begins(const profibus::CharacterRun& run);
  void pass_on(bus::Tick at);

  dsdpv1::systemc::LineStation& chip_;
  const dsdpv1::systemc::TimedModule& module_;
  bus::Segment& segment_;
  TimelineModule& timeline_;
  bus::StationId station_;
  bool enabled_ = false, drives_ = true;
  bool own_run_ = false, hides_txd_ = false;
};

}  // namespace dsdpv1::systemc_bench

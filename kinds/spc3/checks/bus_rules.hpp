#pragma once
// The rules of the bus at the pins: set-up, hold, levels, ready. No document at hand has the chip's times, so each
// default is this project's (A42).
#include <optional>

#include "kinds/spc3/checks/check.hpp"
#include "kinds/spc3/port/bus_reader.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::spc3_checks {

using bus::Tick;
using spc3_bus::BusAccess;

class BusRules {
 public:
  explicit BusRules(checks::Recorder& recorder) : recorder_(recorder) {}

  void reset();
  /// A change of a pin, before `lines` has it.
  void pin(Tick at, spc3::Pin pin, tb::Level level, const spc3::BusLines& lines);
  void began(const BusAccess& access, const spc3::BusLines& lines);
  void ended(Tick at, const BusAccess& access, const spc3::BusLines& lines);

 private:
  void moves(Tick at);
  void address_moves(Tick at);
  void judge_ready(Tick at);

  checks::Recorder& recorder_;
  Tick address_moved_ = 0, data_moved_ = 0;
  std::optional<BusAccess> running_;
  std::optional<Tick> ready_;  ///< XREADY is low since
  std::optional<Tick> hold_;   ///< a write ended, AB and DB have not moved since
};

}  // namespace dsdpv1::spc3_checks

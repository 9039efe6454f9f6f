#pragma once
// The rules of SPI at the pins of a VPC3+S: SCK, MOSI, frames. No document at hand has the chip's times (A59).
#include <optional>

#include "kinds/spc3/checks/check.hpp"
#include "kinds/spc3/port/bus_reader.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::spc3_checks {

using bus::Tick;

class SpiRules {
 public:
  SpiRules(checks::Recorder& recorder, unsigned mode) : recorder_(recorder), takes_at_(mode == 0 || mode == 3) {}

  void reset();
  /// A change of a pin, before `lines` has it.
  void pin(Tick at, spc3::Pin pin, tb::Level level, const spc3::BusLines& lines);
  void ended(const spc3_bus::SpiFrame& frame);

 private:
  void take(Tick at);
  void mosi_moves(Tick at);

  checks::Recorder& recorder_;
  const bool takes_at_;        ///< the level of SCK after the edge that takes MOSI
  std::optional<Tick> taken_;  ///< the last such edge of the frame
  std::optional<Tick> hold_;   ///< MOSI was taken, and has not moved since
  Tick mosi_moved_ = 0;
};

}  // namespace dsdpv1::spc3_checks

#pragma once
// Checks of SP2 on XSS, SCK and MOSI, and of MISO's delay. Pins that change at the same tick may be reported in any
// order.
#include <functional>
#include <limits>
#include <optional>

#include "kinds/dsdpv1/checks/check.hpp"
#include "kinds/dsdpv1/checks/serial_settings.hpp"
#include "model/dsdpv1/pins.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

class SpiTiming {
 public:
  /// `settings` must outlive it.
  SpiTiming(Recorder& recorder, const SerialSettings& settings) : recorder_(recorder), settings_(settings) {}

  /// Drops running measurements; the next frame begins with a fall of XSS.
  void reset() { *this = SpiTiming(recorder_, settings_); }
  /// A change of XSS, SCK, MOSI or MISO, not in reset.
  void pin(Tick at, dsdpv1::Pin pin, dsdpv1::Level level);
  void finish(Tick end);

 private:
  static constexpr Tick kNotYet = std::numeric_limits<Tick>::max();

  /// XSS was low just before `at`: an edge of SCK together with XSS's rise counts, one together with its fall does not.
  bool selected(Tick at) const { return fell_ < at && at <= rose_; }
  void xss(Tick at, bool level);
  void sck_rose(Tick at);
  void sck_fell(Tick at);
  void mosi_changed(Tick at);
  void miso_changed(Tick at, bool driven);
  void end_frame_before(Tick at);
  void record(Check check, Tick at, Tick measured);

  std::reference_wrapper<Recorder> recorder_;
  std::reference_wrapper<const SerialSettings> settings_;
  Tick fell_ = kNotYet, rose_ = kNotYet;     ///< XSS: begin and end of the frame
  bool lag_due_ = false;                     ///< XSS rose; SCK may still fall at the same tick
  unsigned bits_ = 0;                        ///< of the frame, so far
  std::optional<Tick> sck_rose_, sck_fell_;  ///< in the frame
  Tick mosi_changed_ = 0, mosi_changed_before_ = 0;
  std::optional<Tick> hold_;  ///< SCK rose, MOSI has not changed since
};

}  // namespace dsdpv1::checks

#pragma once
// Reads frames and their bytes from XSS, SCK, MOSI and MISO of a DSDPV1-RSU (SP1 to SP3). Pins that change at the same
// tick may be reported in any order.
#include <cstdint>
#include <optional>

#include "bus/time.hpp"
#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::tb {

/// Derived classes receive the frames.
class SpiFrameReader {
 public:
  virtual ~SpiFrameReader() = default;

 protected:
  using Tick = bus::Tick;
  SpiFrameReader() = default;
  SpiFrameReader(const SpiFrameReader&) = default;
  SpiFrameReader& operator=(const SpiFrameReader&) = default;

  /// XSS falls.
  virtual void frame_began(Tick at) = 0;
  /// Eight rises of SCK, the last at `at`.
  virtual void byte(Tick at, std::uint8_t mosi, std::uint8_t miso) = 0;
  /// XSS rose at `at`, and time has advanced.
  virtual void frame_ended(Tick /*at*/) {}

  /// A change of any pin, in order of time.
  void read(Tick at, Pin pin, Level level);
  /// Advances time to `at`. An edge of SCK at the tick of XSS's rise counts, so the frame ends after it.
  void pass(Tick at);
  /// RESET is low: drops a frame in progress.
  void forget_frame();
  /// The end of a frame that XSS's rise has closed.
  Tick frame_end() const { return rose_ ? *rose_ + 1 : bus::kNever; }
  unsigned bits() const { return bits_; }          ///< of the frame, so far
  Tick byte_start() const { return byte_start_; }  ///< first rise of SCK of its last byte, which may be incomplete

 private:
  /// A pin with its level strictly before a tick.
  struct Wire {
    Tick changed = -1;
    bool level = true, earlier = true;

    void set(Tick at, bool to);
    bool before(Tick at) const { return changed == at ? earlier : level; }
  };
  void xss(Tick at, bool level);
  void sck_rose(Tick at);

  Wire mosi_{-1, false, false}, miso_;  ///< levels of a newly constructed chip
  std::optional<Tick> fell_, rose_;     ///< XSS: begin and end of the frame
  unsigned bits_ = 0, out_ = 0, in_ = 0;
  Tick byte_start_ = 0;
};

}  // namespace dsdpv1::tb

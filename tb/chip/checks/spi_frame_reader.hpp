#pragma once
// Reads frames of SPI and their bytes from the four wires of a slave. Wires that change at the same tick may be
// reported in any order.
#include <cstdint>
#include <optional>

#include "bus/time.hpp"
#include "tb/chip/pins/pins.hpp"

namespace dsdpv1::tb {

enum class SpiWire : std::uint8_t { kXss, kSck, kMosi, kMiso };

/// Derived classes receive the frames.
class SpiFrameReader {
 public:
  virtual ~SpiFrameReader() = default;

 protected:
  using Tick = bus::Tick;
  /// `mode`: CPOL in bit 1, CPHA in bit 0.
  explicit SpiFrameReader(unsigned mode = 0) : mode_(mode) {}
  SpiFrameReader(const SpiFrameReader&) = default;
  SpiFrameReader& operator=(const SpiFrameReader&) = default;

  /// XSS falls.
  virtual void frame_began(Tick at) = 0;
  /// Eight edges of SCK that take MOSI, the last at `at`.
  virtual void byte(Tick at, std::uint8_t mosi, std::uint8_t miso) = 0;
  /// XSS rose at `at`, and time has advanced.
  virtual void frame_ended(Tick /*at*/) {}

  /// A change of a wire, in order of time.
  void read(Tick at, SpiWire wire, Level level);
  /// Advances time to `at`. An edge of SCK at the tick of XSS's rise counts, so the frame ends after it.
  void pass(Tick at);
  /// The slave is in reset: drops a frame in progress.
  void forget_frame();
  /// The end of a frame that XSS's rise has closed.
  Tick frame_end() const { return rose_ ? *rose_ + 1 : bus::kNever; }
  unsigned bits() const { return bits_; }  ///< of the frame, so far
  Tick byte_start() const {
    return byte_start_;
  }  ///< first taking edge of SCK of its last byte, which may be incomplete

 private:
  /// A pin with its level strictly before a tick.
  struct Wire {
    Tick changed = -1;
    bool level = true, earlier = true;

    void set(Tick at, bool to);
    bool before(Tick at) const { return changed == at ? earlier : level; }
  };
  void xss(Tick at, bool level);
  void sck_takes(Tick at);

  unsigned mode_;
  Wire mosi_{-1, false, false}, miso_;  ///< levels of a newly constructed chip
  std::optional<Tick> fell_, rose_;     ///< XSS: begin and end of the frame
  unsigned bits_ = 0, out_ = 0, in_ = 0;
  Tick byte_start_ = 0;
};

}  // namespace dsdpv1::tb

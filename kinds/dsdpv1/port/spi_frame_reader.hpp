#pragma once
// Reads frames and their bytes from XSS, SCK, MOSI and MISO of a DSDPV1-RSU (SP1 to SP3).
#include "model/dsdpv1/pins.hpp"
#include "tb/chip/checks/spi_frame_reader.hpp"

namespace dsdpv1::tb {

class RsuFrameReader : public SpiFrameReader {
 protected:
  /// A change of any pin.
  void read(Tick at, Pin pin, Level level) {
    switch (pin) {
      case Pin::kXss: return SpiFrameReader::read(at, SpiWire::kXss, level);
      case Pin::kSck: return SpiFrameReader::read(at, SpiWire::kSck, level);
      case Pin::kMosi: return SpiFrameReader::read(at, SpiWire::kMosi, level);
      case Pin::kMiso: return SpiFrameReader::read(at, SpiWire::kMiso, level);
      default: return pass(at);
    }
  }
};

}  // namespace dsdpv1::tb

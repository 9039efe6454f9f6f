#pragma once
// Reads the frames between host and module for logs and waves.
#include "kinds/xgate/pin_frames.hpp"
#include "tb/chip/host_reader.hpp"

namespace dsdpv1::xgate {

class FrameReader : public tb::HostReader, private PinFrames {
 public:
  using Tick = bus::Tick;
  explicit FrameReader(const ChipSettings& chip) : PinFrames(chip.config(), chip.spi_mode) {}

  const char* port() const override { return config().port == Port::kSpi ? "spi" : "uart"; }
  tb::PinMask pins() const override { return mask(); }
  void pin(Tick at, tb::PinNumber pin, tb::Level level) override {
    now_ = at;
    PinFrames::pin(at, pin, level);
    announce();
  }
  Tick next() const override { return PinFrames::next(); }
  void run(Tick now) override {
    now_ = now;
    PinFrames::run(now);
  }

 private:
  void frame(const HostFrame& frame) override;
};

}  // namespace dsdpv1::xgate

#pragma once
// Reads the frames of SPI between a VPC3+S and its user, for logs and waves.
#include "kinds/spc3/port/bus_reader.hpp"
#include "tb/chip/host_reader.hpp"

namespace dsdpv1::tb {

class Spc3FrameReader : public HostReader, private spc3_bus::AccessSink {
 public:
  explicit Spc3FrameReader(unsigned spi_mode) : reader_(*this, spc3::Bus::kSpi, spi_mode) {}

  const char* port() const override { return "spi"; }
  PinMask pins() const override;
  void pin(bus::Tick at, PinNumber pin, Level level) override;
  bus::Tick next() const override { return reader_.frame_end(); }
  void run(bus::Tick now) override {
    now_ = now;
    reader_.pass(now);
  }

 private:
  void frame_ended(const spc3_bus::SpiFrame& frame) override;

  spc3_bus::BusReader reader_;
};

}  // namespace dsdpv1::tb

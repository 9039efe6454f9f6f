#pragma once
// Reads the telegrams on XSS, SCK, MOSI and MISO of a DSDPV1-RSU.
#include "kinds/dsdpv1/port/host_telegram.hpp"
#include "kinds/dsdpv1/port/spi_frame_reader.hpp"
#include "tb/chip/host_reader.hpp"

namespace dsdpv1::tb {

class SpiReader : public HostReader, private RsuFrameReader {
 public:
  const char* port() const override { return "spi"; }
  PinMask pins() const override;
  void pin(bus::Tick at, PinNumber pin, Level level) override;
  bus::Tick next() const override { return frame_end(); }
  void run(bus::Tick now) override {
    now_ = now;
    pass(now);
  }

 private:
  void frame_began(Tick at) override;
  void byte(Tick at, std::uint8_t mosi, std::uint8_t miso) override;
  void frame_ended(Tick at) override;
  void request_byte(Tick at, std::uint8_t byte);
  void reply_byte(Tick at, std::uint8_t byte);
  void tell_request(Tick end, const std::string& wrong);
  void tell_reply(Tick end, const std::string& wrong);

  Tick request_start_ = 0, reply_start_ = 0;  ///< first rises of SCK
  HostRequest request_{HostLink::kSpi};
  HostReply reply_;
  bool asked_ = false, replied_ = false;  ///< the request, the reply are complete
};

}  // namespace dsdpv1::tb

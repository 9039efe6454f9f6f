#pragma once
// Reads the telegrams on XSS, SCK, MOSI and MISO of a DSDPV1-RSU.
#include <optional>
#include <vector>

#include "kinds/dsdpv1/port/host_telegram.hpp"
#include "model/dsdpv1/pins.hpp"
#include "tb/chip/host_reader.hpp"

namespace dsdpv1::tb {

class SpiReader : public HostReader {
 public:
  const char* port() const override { return "spi"; }
  PinMask pins() const override;
  void pin(bus::Tick at, PinNumber pin, Level level) override;

  /// An edge of SCK at the tick of XSS's rise counts, so a frame ends after it.
  bus::Tick next() const override { return rose_ ? *rose_ + 1 : bus::kNever; }
  void run(bus::Tick now) override {
    now_ = now;
    end_frame_before(now);
  }

 private:
  using Tick = bus::Tick;
  /// A pin whose level strictly before a tick can be asked for.
  struct Wire {
    Tick changed = -1;
    bool level = true, earlier = true;

    void set(Tick at, bool to);
    bool before(Tick at) const { return changed == at ? earlier : level; }
  };
  void xss(Tick at, bool level);
  void sck_rose(Tick at);
  void request_byte(Tick at, std::uint8_t byte);
  void reply_byte(Tick at, std::uint8_t byte);
  void end_frame_before(Tick at);
  void end_frame();
  void tell_request(Tick end, const std::string& wrong);
  void tell_reply(Tick end, const std::string& wrong);

  Wire mosi_{-1, false, false}, miso_;
  std::optional<Tick> fell_, rose_;  ///< XSS: begin and end of the frame
  unsigned bits_ = 0, out_ = 0, in_ = 0;
  Tick byte_start_ = 0, request_start_ = 0, reply_start_ = 0;  ///< first rises of SCK
  HostRequest request_{HostLink::kSpi};
  HostReply reply_;
  bool asked_ = false, replied_ = false;  ///< the request, the reply is complete
};

}  // namespace dsdpv1::tb

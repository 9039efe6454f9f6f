#pragma once
// Reads the telegrams on RXD and TXD of a DSDPV1-RSU: characters at the rate of its strap UBR, telegrams by UA2, UA3
// and UA16.
#include <string>

#include "bus/wire/uart.hpp"
#include "kinds/dsdpv1/port/host_telegram.hpp"
#include "kinds/dsdpv1/port/serial_settings.hpp"
#include "model/dsdpv1/pins.hpp"
#include "tb/chip/host_reader.hpp"

namespace dsdpv1::tb {

class UartReader : public HostReader {
 public:
  using Tick = bus::Tick;
  explicit UartReader(const SerialSettings& settings);

  const char* port() const override { return "uart"; }
  PinMask pins() const override;
  void pin(Tick at, PinNumber pin, Level level) override;
  Tick next() const override;
  void run(Tick now) override;

 private:
  void reset();
  void heard_from_user(const bus::ReceivedCharacter& character);
  void heard_from_chip(const bus::ReceivedCharacter& character);
  bool heard(const bus::ReceivedCharacter& character) const;
  void begin_request(const bus::ReceivedCharacter& character);
  void end_request(Tick end, const std::string& wrong);
  void end_reply(Tick end, const std::string& wrong);
  void silence(Tick now);
  Tick silence_at() const;

  bus::UartReceiver from_user_, from_chip_;
  SerialSettings settings_;
  unsigned b019_ = 0;                                              ///< as written by the user's telegrams
  Tick longest_silence_ = 0;                                       ///< of the present telegram
  Tick idle_since_ = 0;                                            ///< RXD; meaningless while it is low
  bool rxd_ = true;                                                ///< its level
  HostRequest request_{HostLink::kUart}, asked_{HostLink::kUart};  ///< the present one; the one being replied to
  HostReply reply_;
  Tick request_start_ = 0, request_end_ = 0, reply_start_ = 0, reply_end_ = 0;
  std::string spoilt_;     ///< why the chip ignores the present telegram; empty: it does not
  bool replying_ = false;  ///< a request to this card was received, its reply has not ended
};

}  // namespace dsdpv1::tb

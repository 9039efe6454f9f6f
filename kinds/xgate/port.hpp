#pragma once
// The pins of an XGate-DPS10 around its firmware.
#include "kinds/xgate/pins.hpp"
#include "kinds/xgate/settings.hpp"
#include "kinds/xgate/spi_side.hpp"
#include "kinds/xgate/uart_side.hpp"
#include "model/xgate/firmware.hpp"

namespace dsdpv1::xgate {

class ModulePort : public kit::UserPort {
 public:
  explicit ModulePort(kit::Chip& chip);

  void reset() override;
  void input(kit::Tick at, kit::PinNumber pin, kit::Level level) override;
  void eval(Cycle now) override;
  void show(Cycle now) override;
  Cycle next() const override;

 private:
  struct SpiBytes;  // SpiSide's view of the firmware at an edge
  bool by_spi() const { return config_.port == Port::kSpi; }
  void release(Cycle now);
  void show_led(Cycle now, kit::PinNumber pin, Led led) { chip_.drive_at(now, pin, firmware_.led(led, now) ? 1 : 0); }

  kit::Chip& chip_;
  const Config config_;
  Firmware firmware_;
  UartIn in_;
  UartOut out_;
  SpiSide spi_;
  bool released_ = false;
  Cycle now_ = 0;
  Cycle acts_at_ = profibus::kNever;  ///< a byte of SPI has ended: /INT follows
};

}  // namespace dsdpv1::xgate

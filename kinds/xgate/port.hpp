#pragma once
// The pins of an XGate-DPS10 around its firmware.
#include <string>
#include <utility>
#include <vector>

#include "kinds/xgate/pins.hpp"
#include "kinds/xgate/settings.hpp"
#include "kinds/xgate/spi_side.hpp"
#include "kinds/xgate/uart_side.hpp"
#include "model/xgate/firmware.hpp"

namespace dsdpv1::xgate {

class ModulePort : public kit::UserPort, private kit::StoredPort {
 public:
  explicit ModulePort(kit::Chip& chip);

  void reset() override;
  void input(kit::Tick at, kit::PinNumber pin, kit::Level level) override;
  void eval(Cycle now) override;
  void show(Cycle now) override;
  Cycle next() const override;
  kit::StoredPort* stored() override { return this; }

 private:
  // kit::StoredPort
  void store(profibus::StateWriter& archive) override { store_members(archive); }
  void store(profibus::StateReader& archive) override { store_members(archive); }
  std::vector<std::pair<std::string, std::uint32_t>> parameters() const override;
  template <class Archive>
  void store_members(Archive& archive) {
    archive(firmware_, in_, out_, spi_, released_);
    archive.cycles(now_, acts_at_);
  }

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

#pragma once
// The rules of the host of an XGate-DPS10, judged from the pins between both (docs/checks.md): bytes by UART or SPI,
// frames, /INT and /Rst.
#include <functional>
#include <optional>
#include <utility>

#include "kinds/xgate/line_edges.hpp"
#include "kinds/xgate/link_rules.hpp"
#include "kinds/xgate/pin_frames.hpp"
#include "kinds/xgate/pins.hpp"
#include "tb/chip/checks/chip_checks.hpp"

namespace dsdpv1::xgate_checks {

class Checks : public checks::ChipChecks, private xgate::PinFrames {
 public:
  using Tick = bus::Tick;
  /// `pins`: the kind's; must outlive it. `config`: the module's.
  Checks(const checks::Limits& limits, const tb::PinTable& pins, const xgate::Config& config, unsigned spi_mode);

  static tb::PinMask watched() { return PinFrames::mask() | tb::mask_of(xgate::kInt); }

  void pin(Tick at, tb::PinNumber pin, tb::Level level) override;
  void telegram(Tick now, const bus::WireTelegram& telegram) override;
  void finish(Tick end) override;

  /// Only those of the port that is used.
  bool applies(checks::CheckId check) const override;
  const checks::Record& record(checks::CheckId check) const override { return recorder_.record(check); }
  const checks::Limit& limit(checks::CheckId check) const override { return recorder_.limit(check); }
  void on_violation(std::function<void(const checks::Violation&)> sink) override {
    recorder_.on_violation = std::move(sink);
  }

 private:
  // xgate::PinFrames
  void frame(const xgate::HostFrame& frame) override { link_.frame(frame); }
  void byte_of_frame(Tick end, Tick last_end) override { link_.byte(end, last_end); }
  void nss_rose(Tick at, unsigned bits) override;
  void rate_changed() override { follow_rate(); }

  bool by_spi() const { return config().port == xgate::Port::kSpi; }
  void follow_rate();
  void reset(Tick at, bool low);
  void advance(Tick at);
  void sck(Tick at, bool level);

  const bool sck_takes_at_;  ///< the level of SCK after the edge that takes MOSI
  checks::PinHistory history_;
  checks::Recorder recorder_;
  const bool own_rate_limit_, own_gap_limit_;  ///< of the scenario
  LineEdges rxd_;
  LinkRules link_;
  bool in_reset_ = true, selected_ = false;
  std::optional<Tick> taken_;  ///< SPI: the last edge of SCK in this frame that takes MOSI
};

}  // namespace dsdpv1::xgate_checks

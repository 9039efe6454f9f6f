#include "kinds/dsdpv1/rtl/rtl_of.hpp"

#include "cosim/reference_rtl.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/rtl/access_watch.hpp"
#include "kinds/dsdpv1/rtl/limits.hpp"

namespace dsdpv1::cosim {
namespace {

const dsdpv1::Config& config_of(const tb::OwnSettings& chip) { return static_cast<const tb::Dsdpv1Settings&>(chip); }

RtlLimits limits_of(const dsdpv1::Config& config) {
  return {config.access_interval, config.ready_cycles,  config.rts_lead,         config.rts_trail,
          config.intr_low,        config.intr_gap,      config.search_window_ms, config.search_window_bits,
          config.baud_control_ms, config.spi_reply_gap, config.spi_write_gap,    config.serial_block_crc,
          config.u_timer,         config.uart_min_tsdr, config.uart_cfg_length,  config.uart_gaps};
}

class Dsdpv1Rtl : public RtlOf {
 public:
  explicit Dsdpv1Rtl(Part part) : part_(part) {}

  /// Strobes act at their own tick, and of the DSDPV1-RSU SCK; MISO follows its register later
  /// (docs/microarchitecture_rsu.md, 5.1).
  RtlTiming timing(const tb::OwnSettings& chip) const override {
    RtlTiming timing;
    timing.at_once = mask(Pin::kReset) | mask(Pin::kCsr) | mask(Pin::kRd) | mask(Pin::kWr);
    if (part_ != Part::kRsu) return timing;
    timing.at_once |= mask(Pin::kXss) | mask(Pin::kSck);
    timing.clock = number(Pin::kSck);
    timing.data = number(Pin::kMosi);
    timing.delayed = number(Pin::kMiso);
    timing.delay = config_of(chip).spi_miso_delay;
    return timing;
  }
  std::unique_ptr<MemoryWatch> watch_memory() const override { return std::make_unique<AccessWatch>(part_); }
  std::unique_ptr<Rtl> make_reference(const tb::OwnSettings& chip, unsigned fault, std::uint32_t seed) const override {
    const RtlLimits limits = limits_of(config_of(chip));
    const char* top = part_ == Part::kRsu ? "dsdpv1_rsu" : "dsdpv1";
    return make_design(reference_library(top, fault != 0), {2, seed, fault, &limits});
  }

 private:
  Part part_;
};

}  // namespace

const RtlOf& rtl_of(Part part) {
  static const Dsdpv1Rtl plain(Part::kDsdpv1), rsu(Part::kRsu);
  return part == Part::kRsu ? rsu : plain;
}

}  // namespace dsdpv1::cosim

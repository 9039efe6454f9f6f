#include "kinds/dsdpv1/rtl/rtl_of.hpp"

#include "cosim/reference_rtl.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/rtl/access_watch.hpp"

namespace dsdpv1::cosim {
namespace {

const dsdpv1::Config& config_of(const tb::OwnSettings& chip) { return static_cast<const tb::Dsdpv1Settings&>(chip); }

RtlParameter parameter(const char* key, std::uint32_t value, std::uint32_t usual) {
  return {key, {value}, 32, value == usual};
}

/// Several numbers are one vector of 16 bits each.
template <std::size_t N>
RtlParameter parameter(const char* key, const std::array<std::uint32_t, N>& values,
                       const std::array<std::uint32_t, N>& usual) {
  RtlParameter row{key, {}, 16 * static_cast<int>(N), values == usual};
  for (std::size_t i = 0; i < N; i += 2) row.words.push_back(values.at(i) | values.at(i + 1) << 16U);
  return row;
}

std::vector<RtlParameter> parameters_of(const dsdpv1::Config& config, bool serial) {
  const dsdpv1::Config usual;
  std::vector<RtlParameter> rows;
#define DSDPV1_PARAMETER(name, ...) rows.push_back(parameter(#name, config.name, usual.name));
#define DSDPV1_RSU_PARAMETER(name, ...) \
  if (serial) rows.push_back(parameter(#name, config.name, usual.name));
#define DSDPV1_RSU_TICKS(...)
#define DSDPV1_RSU_LIST DSDPV1_RSU_PARAMETER
#include "model/dsdpv1/parameters.inc"
  return rows;
}

class Dsdpv1Rtl : public RtlOf {
 public:
  explicit Dsdpv1Rtl(Part part) : part_(part) {}

  std::vector<RtlParameter> parameters(const tb::OwnSettings& chip) const override {
    return parameters_of(config_of(chip), has_serial_ports(part_));
  }

  /// Strobes act at their own tick, as does SCK of the DSDPV1-RSU; MISO follows its register later
  /// (docs/microarchitecture_rsu.md, 5.1).
  RtlTiming timing(const tb::OwnSettings& chip) const override {
    RtlTiming timing;
    timing.at_once = mask(Pin::kReset) | mask(Pin::kCsr) | mask(Pin::kRd) | mask(Pin::kWr);
    if (!has_serial_ports(part_)) return timing;
    timing.at_once |= mask(Pin::kXss) | mask(Pin::kSck);
    timing.clock = number(Pin::kSck);
    timing.data = number(Pin::kMosi);
    timing.delayed = number(Pin::kMiso);
    timing.delay = config_of(chip).spi_miso_delay;
    return timing;
  }
  std::unique_ptr<MemoryWatch> watch_memory() const override { return std::make_unique<AccessWatch>(part_); }
  std::unique_ptr<Rtl> make_reference(const tb::OwnSettings& chip, unsigned fault, std::uint32_t seed) const override {
    return make_design(reference_library(row(part_).rtl, fault != 0), {2, seed, fault, &config_of(chip)});
  }

 private:
  Part part_;
};

}  // namespace

std::unique_ptr<const RtlOf> make_rtl_of(Part part) { return std::make_unique<Dsdpv1Rtl>(part); }

}  // namespace dsdpv1::cosim

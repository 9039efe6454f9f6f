#include "kinds/dsdpv1/checks/check.hpp"

#include <cstddef>

#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::checks {
namespace {

constexpr std::uint32_t kUserHandshake = mask(Pin::kRReq) | mask(Pin::kRSta);
constexpr std::uint32_t kHandshake = kUserHandshake | mask(Pin::kLReq) | mask(Pin::kLSta);
constexpr std::uint32_t kWriteStrobe = mask(Pin::kCsr) | mask(Pin::kWr) | mask(Pin::kA) | mask(Pin::kDIn);
constexpr std::uint32_t kReadStrobe = mask(Pin::kCsr) | mask(Pin::kRd) | mask(Pin::kA);
constexpr std::uint32_t kUserPort = kUserHandshake | mask(Pin::kCsr) | mask(Pin::kRd) | mask(Pin::kWr);
constexpr std::uint32_t kInterruptPins = kUserHandshake | mask(Pin::kIntr0);
constexpr std::uint32_t kServicePins = kInterruptPins | mask(Pin::kPbrts);
constexpr std::uint32_t kSpiClock = mask(Pin::kXss) | mask(Pin::kSck);
constexpr std::uint32_t kSpiData = mask(Pin::kSck) | mask(Pin::kMosi);
constexpr std::uint32_t kSpiReply = mask(Pin::kXss) | mask(Pin::kSck) | mask(Pin::kMiso);
constexpr std::uint32_t kRxdPin = mask(Pin::kRxd);
constexpr std::uint32_t kUartPins = mask(Pin::kRxd) | mask(Pin::kTxd);

const RuleTable& all_rules() {
  static const RuleTable table = {
#define X(enumerator, id, bound, limit, pins, ...) {id, Bound::bound, limit, pins, __VA_ARGS__},
#include "kinds/dsdpv1/checks/check_table.inc"
#undef X
  };
  return table;
}

}  // namespace

const RuleTable& rules(Part part) {
  static const RuleTable parallel(all_rules().begin(),
                                  all_rules().begin() + static_cast<std::ptrdiff_t>(kFirstSpiCheck));
  return has_serial_ports(part) ? all_rules() : parallel;
}

const Rule& rule(CheckId check) { return all_rules().at(check.index); }

}  // namespace dsdpv1::checks

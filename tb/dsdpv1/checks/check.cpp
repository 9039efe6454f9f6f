#include "tb/dsdpv1/checks/check.hpp"

#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::checks {
namespace {

constexpr std::uint32_t kUserHandshake = mask(Pin::kRReq) | mask(Pin::kRSta);
constexpr std::uint32_t kHandshake = kUserHandshake | mask(Pin::kLReq) | mask(Pin::kLSta);
constexpr std::uint32_t kWriteStrobe = mask(Pin::kCsr) | mask(Pin::kWr) | mask(Pin::kA) | mask(Pin::kDIn);
constexpr std::uint32_t kReadStrobe = mask(Pin::kCsr) | mask(Pin::kRd) | mask(Pin::kA);
constexpr std::uint32_t kUserPort = kUserHandshake | mask(Pin::kCsr) | mask(Pin::kRd) | mask(Pin::kWr);
constexpr std::uint32_t kInterruptPins = kUserHandshake | mask(Pin::kIntr0);

}  // namespace

const RuleTable& rules() {
  static const RuleTable table = {
#define X(enumerator, id, bound, limit, pins, ...) {id, Bound::bound, limit, pins, __VA_ARGS__},
#include "tb/dsdpv1/checks/check_table.inc"
#undef X
  };
  return table;
}

const Rule& rule(CheckId check) { return rules().at(check.index); }

}  // namespace dsdpv1::checks

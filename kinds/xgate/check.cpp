#include "kinds/xgate/check.hpp"

#include "kinds/xgate/pins.hpp"

namespace dsdpv1::xgate_checks {
namespace {

using checks::Bound;
using checks::kNoLimit;

constexpr std::uint32_t pin(tb::PinNumber number) { return 1U << number; }
constexpr std::uint32_t kResetPin = pin(kit::kReset), kRxdPin = pin(xgate::kHostRxd), kIntPin = pin(xgate::kInt),
                        kLinePins = kRxdPin | pin(xgate::kHostTxd),
                        kSpiPins = pin(xgate::kNss) | pin(xgate::kSck) | pin(xgate::kMosi),
                        kHostPins = kRxdPin | kSpiPins;

}  // namespace

const checks::RuleTable& rules() {
  static const checks::RuleTable table = {
#define X(enumerator, id, bound, limit, pins, ...) {id, Bound::bound, limit, pins, __VA_ARGS__},
#include "kinds/xgate/check_table.inc"
#undef X
  };
  return table;
}

}  // namespace dsdpv1::xgate_checks

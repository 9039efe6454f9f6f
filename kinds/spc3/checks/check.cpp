#include "kinds/spc3/checks/check.hpp"

#include "model/spc3/pins.hpp"

namespace dsdpv1::spc3_checks {
namespace {

using checks::Bound;
using checks::kNoLimit;
using spc3::Pin;

constexpr std::uint32_t kResetPin = mask(Pin::kReset), kInterruptPin = mask(Pin::kXInt),
                        kExchangePin = mask(Pin::kXDataExch),
                        kBusPins = mask(Pin::kXCs) | mask(Pin::kXRd) | mask(Pin::kXWr) | mask(Pin::kAle) |
                                   mask(Pin::kAb) | mask(Pin::kDbIn) | mask(Pin::kXReady),
                        kSpiPins = mask(Pin::kXss) | mask(Pin::kSck) | mask(Pin::kMosi) | mask(Pin::kMiso);

}  // namespace

const checks::RuleTable& rules() {
  static const checks::RuleTable table = {
#define X(enumerator, id, bound, limit, pins, ...) {id, Bound::bound, limit, pins, __VA_ARGS__},
#include "kinds/spc3/checks/check_table.inc"
#undef X
  };
  return table;
}

}  // namespace dsdpv1::spc3_checks

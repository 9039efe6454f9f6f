#include "model/xgate/reasons.hpp"

#include <iterator>

namespace dsdpv1::xgate {

const profibus::ReasonRow detail::kReasonRows[] = {
#define X(id, severity, ...) {profibus::Severity::severity, __VA_ARGS__},
#include "model/xgate/reasons.inc"
#undef X
};

profibus::ReasonTable reasons() { return {detail::kReasonRows, std::size(detail::kReasonRows)}; }

}  // namespace dsdpv1::xgate

#include "model/dpram/reasons.hpp"

#include <iterator>

namespace dsdpv1::dpram {

using profibus::Severity;

const profibus::ReasonRow detail::kReasonRows[] = {
#define X(id, severity, ...) {Severity::severity, __VA_ARGS__},
#include "model/dpram/reasons.inc"
#undef X
};

profibus::ReasonTable reasons() { return {detail::kReasonRows, std::size(detail::kReasonRows)}; }

}  // namespace dsdpv1::dpram

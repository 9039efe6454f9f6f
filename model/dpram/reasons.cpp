#include "model/dpram/reasons.hpp"

#include <iterator>

namespace dsdpv1::dpram {

using profibus::Severity;

const profibus::ReasonRow detail::kReasonRows[] = {
#define X(id, severity, code, text, advice) {Severity::severity, code, text, advice},
#include "model/dpram/reasons.inc"
#undef X
};

profibus::ReasonTable reasons() { return {detail::kReasonRows, std::size(detail::kReasonRows)}; }

}  // namespace dsdpv1::dpram

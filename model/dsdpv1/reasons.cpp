#include "model/dsdpv1/reasons.hpp"

#include <iterator>

namespace dsdpv1 {

using profibus::Severity;

const profibus::ReasonRow detail::kReasonRows[] = {
#define X(id, severity, ...) {Severity::severity, __VA_ARGS__},
#include "model/dsdpv1/reasons.inc"
#undef X
};

namespace {

constexpr profibus::Words words_with_pins() {
  profibus::Words words = dpram::make_words();
  words.new_block = "INTR0";
  return words;
}
}  // namespace

const profibus::Words kWords = words_with_pins();

std::vector<profibus::Reason> reasons() {
  return profibus::reasons_of(
      {{detail::kReasonRows, std::size(detail::kReasonRows)}, dpram::reasons(), profibus::reasons()});
}

}  // namespace dsdpv1

#include "tests/mailbox/reasons.hpp"

#include <iterator>

namespace dsdpv1::mailbox {

using profibus::Severity;

const profibus::ReasonRow detail::kReasonRows[] = {
#define X(id, severity, ...) {Severity::severity, __VA_ARGS__},
#include "tests/mailbox/reasons.inc"
#undef X
};

namespace {

// Fixed properties of this chip appear as their value, the others as their place in the start frame.
constexpr profibus::Words make_words() {
  profibus::Words words;
  words.ident = "bytes 2 and 3 of the start frame";
  words.max_io = "8 and 8 bytes, which are fixed,";
  words.max_prm = "0, fixed";
  words.initial_cfg = "17 27, fixed";
  words.input_length = "8, fixed,";
  words.new_block = "INT";
  return words;
}
}  // namespace

const profibus::Words kWords = make_words();

std::vector<profibus::Reason> reasons() {
  return profibus::reasons_of({{detail::kReasonRows, std::size(detail::kReasonRows)}, profibus::reasons()});
}

}  // namespace dsdpv1::mailbox

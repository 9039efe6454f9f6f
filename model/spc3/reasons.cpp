#include "model/spc3/reasons.hpp"

#include <iterator>

namespace dsdpv1::spc3 {

using profibus::Severity;

const profibus::ReasonRow detail::kReasonRows[] = {
#define X(id, severity, ...) {Severity::severity, __VA_ARGS__},
#include "model/spc3/reasons.inc"
#undef X
};

namespace {

constexpr profibus::Words make_words() {
  profibus::Words words;
  words.address_change = "the pointer 2EH";
  words.sync = "mode register 0 bit 6";
  words.freeze = "mode register 0 bit 7";
  words.ident = "3AH, 3BH";
  words.max_diag = "24H, 25H";
  words.prm_verdict = "0FH";
  words.cfg_verdict = "11H";
  words.prm_answer = "0EH or 0FH";
  words.cfg_answer = "10H or 11H";
  words.new_block = "X/INT";
  return words;
}
}  // namespace

const profibus::Words kWords = make_words();

std::vector<profibus::Reason> reasons() {
  return profibus::reasons_of({{detail::kReasonRows, std::size(detail::kReasonRows)}, profibus::reasons()});
}

}  // namespace dsdpv1::spc3

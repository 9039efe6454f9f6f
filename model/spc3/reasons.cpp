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
constexpr profibus::Words kWords = make_words();

}  // namespace

std::vector<profibus::Reason> reasons() {
  std::vector<profibus::Reason> all;
  const profibus::ReasonTable own = {detail::kReasonRows, std::size(detail::kReasonRows)};
  for (const profibus::ReasonTable& room : {own, profibus::reasons()})
    for (const profibus::ReasonRow& row : room) all.emplace_back(row);
  return all;
}

std::string describe(const profibus::Event& event) { return profibus::describe(event, kWords); }
std::string text_template(profibus::Reason reason) { return profibus::text_template(reason, kWords); }
std::string advice(profibus::Reason reason) { return profibus::advice(reason, kWords); }

}  // namespace dsdpv1::spc3

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

}  // namespace dsdpv1::mailbox

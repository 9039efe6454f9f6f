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
constexpr profibus::Words kWords = words_with_pins();

}  // namespace

std::vector<profibus::Reason> reasons() {
  std::vector<profibus::Reason> all;
  const profibus::ReasonTable own = {detail::kReasonRows, std::size(detail::kReasonRows)};
  for (const profibus::ReasonTable& room : {own, dpram::reasons(), profibus::reasons()})
    for (const profibus::ReasonRow& row : room) all.emplace_back(row);
  return all;
}

std::string describe(const profibus::Event& event) { return profibus::describe(event, kWords); }
std::string text_template(profibus::Reason reason) { return profibus::text_template(reason, kWords); }
std::string advice(profibus::Reason reason) { return profibus::advice(reason, kWords); }

}  // namespace dsdpv1

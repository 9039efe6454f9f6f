#pragma once
// The reasons of the DPRAM, and its words for the places named in the reasons of every DP slave.
#include "model/profibus/reason.hpp"
#include "model/profibus/words.hpp"

namespace dsdpv1::dpram {

namespace detail {
enum class ReasonIndex : std::size_t {
#define X(id, ...) id,
#include "model/dpram/reasons.inc"
#undef X
  kCount
};
extern const profibus::ReasonRow kReasonRows[static_cast<std::size_t>(ReasonIndex::kCount)];
}  // namespace detail

/// Reasons that only a chip with this DPRAM has: `dpram::Reason::kInitCrc`.
struct Reason {
#define X(id, ...) \
  static constexpr profibus::Reason id{detail::kReasonRows[static_cast<std::size_t>(detail::ReasonIndex::id)]};
#include "model/dpram/reasons.inc"
#undef X
};

profibus::ReasonTable reasons();

/// Table 2's addresses.
constexpr profibus::Words make_words() {
  profibus::Words words;
  words.address_change = "B024.0";
  words.freeze = "B024.1";
  words.sync = "B024.2";
  words.fail_safe = "B024.3";
  words.ident = "B022, B023";
  words.max_io = "B027/B028";
  words.max_diag = "B029";
  words.max_prm = "B02A";
  words.max_cfg = "B02C";
  words.initial_cfg = "B02F..";
  words.input_length = "B501";
  words.prm_verdict = "B00C.0";
  words.cfg_verdict = "B00C.1";
  words.prm_answer = "B00C.0 and B010.7";
  words.cfg_answer = "B00C.1 and B010.6";
  words.dpv1_was_off = "B005 was not 1D";
  words.dpv1_on = "write 1D to B005";
  words.c1_request = "B00F.0";
  words.c2_request = "B00F.1";
  words.acyclic_requests = "B00F";
  return words;
}

}  // namespace dsdpv1::dpram

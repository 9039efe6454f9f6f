#include "kinds/user_cpu/claim_counters.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::user_cpu {
namespace {

/// The value that the frame writes to B014 (SP12); -1: another telegram.
int ownership(const std::vector<std::uint8_t>& out) {
  const bool write = out.size() > 10 && out[0] >> 5 == 1 && out[1] == 0x00 && out[2] == 0x14 && out[3] == 1;
  return write ? out[4] : -1;
}

/// The reply belongs to a write and has no error.
bool granted(const std::vector<std::uint8_t>& in) {
  constexpr std::size_t kRequest = 7;
  const auto first = std::find_if(in.begin() + kRequest, in.end(), [](std::uint8_t byte) { return byte != 0xFF; });
  return first != in.end() && *first >> 5 == 5;
}

}  // namespace

void ClaimCounters::frame(const std::vector<std::uint8_t>& out, const std::vector<std::uint8_t>& in, Tick begun,
                          Tick ended) {
  const int value = ownership(out);
  if (value < 0) return;
  if (value == 2 && held_at_ < 0) {
    if (asked_at_ < 0) asked_at_ = begun;
    if (!granted(in)) return;
    held_at_ = ended;
    ++counters_.holds;
    counters_.longest_wait = std::max(counters_.longest_wait, held_at_ - std::exchange(asked_at_, -1));
  } else if (value == 0 && held_at_ >= 0 && granted(in)) {
    counters_.longest_hold = std::max(counters_.longest_hold, ended - std::exchange(held_at_, -1));
  }
}

}  // namespace dsdpv1::user_cpu

#include "tb/serve/line_limit.hpp"

namespace dsdpv1::tb::serve {

bool LineLimit::allows(WallTime now) {
  if (count_ == 0) begun_ = now;
  return ++count_ <= kMost;
}

std::uint64_t LineLimit::left_out(WallTime now, bool after) {
  if (count_ == 0 || (after && now - begun_ < kSpan)) return 0;
  const std::uint64_t left_out = count_ > kMost ? count_ - kMost : 0;
  count_ = 0;
  return left_out;
}

}  // namespace dsdpv1::tb::serve

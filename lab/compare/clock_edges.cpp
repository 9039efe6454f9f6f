#include "lab/compare/clock_edges.hpp"

#include <filesystem>

#include "io/input/input_error.hpp"

namespace dsdpv1::tb::compare {
namespace {

/// A's, unless only B has it.
const Side& side_of(const Clock& clock, const Side& a, const Side& b) {
  return b.nets().knows(clock.signal) && !a.nets().knows(clock.signal) ? b : a;
}

/// A FIFO gives its bytes once.
Side once_more(const Side& side) {
  if (!std::filesystem::is_regular_file(side.path()))
    throw InputError(side.path(), 0, "has the clock and is no regular file, expected one: it is read twice");
  return {side.path(), side.scope()};
}

}  // namespace

ClockEdges::ClockEdges(const Clock& clock, const Side& a, const Side& b, const Scale& scale, Time shift_of_b)
    : rising_(clock.rising), side_(once_more(side_of(clock, a, b))), touched_(1) {
  const Net& net = side_.nets().find(clock.signal);
  if (net.kind != WaveKind::kBits || net.width != 1)
    throw InputError(side_.path(), 0, net.name() + " is no clock, expected a signal of one bit");
  probe_ = side_.watch({net}, touched_, 0);
  side_.start(scale, &side_of(clock, a, b) == &b ? shift_of_b : 0);
}

std::optional<Time> ClockEdges::next() {
  const std::string_view active = rising_ ? "1" : "0", idle = rising_ ? "0" : "1";
  while (const std::optional<Time> at = side_.next()) {
    const bool was_idle = side_.value(probe_) == idle;
    side_.advance(*at);
    if (was_idle && side_.value(probe_) == active) return at;
  }
  return std::nullopt;
}

}  // namespace dsdpv1::tb::compare

#include "lab/traces/difference.hpp"

#include <fmt/format.h>

namespace dsdpv1::tb::traces {
namespace {

std::string side_words(const Signal& signal, const Side& side) {
  return (side.changed ? "" : "still ") + level_words(signal, side.level);
}

}  // namespace

std::string what_differs(const Difference& difference) {
  const Signal& signal = difference.signal;
  const std::string name =
      signal.kind == Signal::Kind::kLine ? "the line" : fmt::format("pin {} of {}", signal.name, signal.slave);
  return fmt::format("{}: golden {}, here {}", name, side_words(signal, difference.golden),
                     side_words(signal, difference.here));
}

}  // namespace dsdpv1::tb::traces

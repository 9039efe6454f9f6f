#include "tb/bench/pin_trace.hpp"

#include <fmt/format.h>

namespace tb {
namespace {

std::string level_text(dsdpv1::Pin pin, dsdpv1::Level level) {
  if (level == dsdpv1::kLevelZ) return "z";
  if (level == dsdpv1::kLevelX) return "x";
  return dsdpv1::width(pin) == 1 ? fmt::format("{}", level) : fmt::format("{:02X}", level);
}

}  // namespace

void PinTrace::change(std::size_t number, const std::string& slave, bus::Tick at, dsdpv1::Pin pin,
                      dsdpv1::Level level) {
  if (at != at_) flush();
  at_ = at;
  const bus::Tick cycle = at / profibus::kTicksPerCycle, rest = at % profibus::kTicksPerCycle;
  const std::string time = rest == 0 ? fmt::format("{}", cycle) : fmt::format("{}+{}", cycle, rest);
  lines_[number] += fmt::format("{} {} {} {}\n", time, slave, dsdpv1::name(pin), level_text(pin, level));
}

void PinTrace::flush() {
  for (const auto& [number, text] : lines_) file_.write(text);
  lines_.clear();
}

void PinTrace::finish() {
  flush();
  file_.commit();
}

}  // namespace tb

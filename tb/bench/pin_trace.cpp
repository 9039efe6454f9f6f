#include "tb/bench/pin_trace.hpp"

#include <fmt/format.h>

#include "model/profibus/time.hpp"

namespace dsdpv1::tb {
void PinTrace::pin(std::size_t slave, bus::Tick at, PinNumber pin, Level level) {
  const PinInfo& info = scenario_.slaves[slave].kind->pins()[pin];
  if (info.input || at < from_) return;
  if (at != at_) flush();
  at_ = at;
  const bus::Tick cycle = at / profibus::kTicksPerCycle, rest = at % profibus::kTicksPerCycle;
  const std::string time = rest == 0 ? fmt::format("{}", cycle) : fmt::format("{}+{}", cycle, rest);
  lines_[slave] +=
      fmt::format("{} {} {} {}\n", time, scenario_.slaves[slave].name.text, info.name, level_text(info, level));
}

void PinTrace::flush() {
  for (const auto& [number, text] : lines_) file_.write(text);
  lines_.clear();
}

void PinTrace::finish() {
  flush();
  file_.commit();
}

}  // namespace dsdpv1::tb

#include "tb/bench/pin_trace.hpp"

#include <fmt/format.h>

#include "model/profibus/time.hpp"

namespace tb {
void PinTrace::change(std::size_t number, const std::string& slave, bus::Tick at, const PinInfo& pin, Level level) {
  if (at != at_) flush();
  at_ = at;
  const bus::Tick cycle = at / profibus::kTicksPerCycle, rest = at % profibus::kTicksPerCycle;
  const std::string time = rest == 0 ? fmt::format("{}", cycle) : fmt::format("{}+{}", cycle, rest);
  lines_[number] += fmt::format("{} {} {} {}\n", time, slave, pin.name, level_text(pin, level));
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

#include "lab/traces/signals.hpp"

#include <fmt/format.h>

namespace dsdpv1::tb::traces {

Signals signals_of(const scenario::Scenario& scenario) {
  Signals signals;
  for (const scenario::Slave& slave : scenario.slaves)
    for (const PinInfo& pin : scenario.kind->pins())
      signals.push_back(
          {slave.name.text, pin.name, pin.width, pin.input ? Signal::Kind::kInput : Signal::Kind::kOutput});
  signals.push_back({"bus", "line", 1, Signal::Kind::kLine});
  return signals;
}

std::string level_words(const Signal& signal, Level level) {
  if (level == kLevelZ) return "Z";
  if (level == kLevelX) return "X";
  return signal.width == 1 ? fmt::format("{}", level) : fmt::format("{:0{}X}", level, (signal.width + 3) / 4);
}

}  // namespace dsdpv1::tb::traces

#pragma once
// A small scenario without files, and traces of it made by hand.
#include <initializer_list>
#include <memory>

#include "lab/traces/trace.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::traces_test {

using tb::Level;
using tb::Tick;

constexpr Tick kEnd = 1'000'000;

inline tb::scenario::Scenario small_scenario() {
  return tb::scenario::parse(
      "name: small\nbaud: 12M\nend: 1ms\nslaves:\n  - {name: io, address: 5, init: {ident: 1, max_inputs: 1, "
      "max_outputs: 1, cfg: \"30\"}}\n",
      "small.yaml");
}

/// A pin of the slave io.
inline std::size_t signal_of(const tb::scenario::Scenario& scenario, const std::string& pin) {
  const tb::traces::Signals signals = tb::traces::signals_of(scenario);
  for (std::size_t i = 0; i < signals.size(); ++i)
    if (signals[i].name == pin) return i;
  throw std::logic_error("no signal " + pin);
}

struct Change {
  const char* pin;
  Tick at;
  Level level;
};
using Changes = std::vector<Change>;

/// All signals are 0 at first.
inline void play(tb::traces::Sink& sink, const tb::scenario::Scenario& scenario, const Changes& changes) {
  for (std::size_t i = 0; i < tb::traces::signals_of(scenario).size(); ++i) sink.change(i, 0, 0);
  for (const Change& each : changes) sink.change(signal_of(scenario, each.pin), each.at, each.level);
}

inline std::unique_ptr<tb::traces::Trace> trace_of(const tb::scenario::Scenario& scenario, const Changes& changes) {
  tb::traces::TraceWriter writer(tb::traces::signals_of(scenario));
  play(writer, scenario, changes);
  return std::make_unique<tb::traces::Trace>(writer.content(kEnd), "small.trace.xz");
}

}  // namespace dsdpv1::traces_test

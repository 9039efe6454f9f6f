#include "lab/traces/trace_wave.hpp"

#include <algorithm>
#include <memory>

#include "io/waves/wave_writer.hpp"

namespace dsdpv1::tb::traces {
namespace {

std::vector<WaveWriter::Signal> declare(const Signals& signals, WaveWriter& writer) {
  std::vector<WaveWriter::Signal> declared;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (i == 0 || signals[i].slave != signals[i - 1].slave) writer.open_scope(signals[i].slave);
    declared.push_back(writer.wire(signals[i].name, signals[i].width));
    if (i + 1 == signals.size() || signals[i].slave != signals[i + 1].slave) writer.close_scope();
  }
  return declared;
}

}  // namespace

void write_wave(const Trace& trace, const std::string& path) {
  const std::unique_ptr<WaveWriter> writer = open_wave(path);
  const std::vector<WaveWriter::Signal> wires = declare(trace.signals(), *writer);
  std::vector<Cursor> cursors = trace.cursors();
  for (;;) {
    const auto next = std::min_element(cursors.begin(), cursors.end(),
                                       [](const Cursor& a, const Cursor& b) { return a.at() < b.at(); });
    if (next == cursors.end() || next->at() == bus::kNever || writer->failed()) break;
    writer->set(next->at(), wires[static_cast<std::size_t>(next - cursors.begin())], next->level());
    next->step();
  }
  writer->check();
  writer->finish(trace.end());
}

}  // namespace dsdpv1::tb::traces

#include "tb/bench/run_log.hpp"

#include <fmt/format.h>

#include <utility>

namespace tb {

std::string nanoseconds(bus::Tick tick) {
  const bus::Tick thousandths = ((tick % bus::kTicksPerNs) * 1000 + bus::kTicksPerNs / 2) / bus::kTicksPerNs;
  return fmt::format("{}.{:03}", tick / bus::kTicksPerNs, thousandths);
}

void RunLog::line(bus::Tick at, const std::string& station, const std::string& kind, const std::string& text) {
  add(at, station, kind, text, {});
}

void RunLog::finding(bus::Tick at, const std::string& station, const std::string& kind, const std::string& text) {
  add(at, station, kind, text, text);
}

void RunLog::add(bus::Tick at, const std::string& station, const std::string& kind, const std::string& text,
                 std::string order) {
  waiting_.emplace(std::tuple(at, station, std::move(order)),
                   fmt::format("{:>17} ns  {:<12} {:<9} {}\n", nanoseconds(at), station, kind, text));
}

void RunLog::flush(bus::Tick now) {
  const bool anything = !waiting_.empty() && std::get<0>(waiting_.begin()->first) <= now;
  while (!waiting_.empty() && std::get<0>(waiting_.begin()->first) <= now) {
    file_.write(waiting_.begin()->second);
    waiting_.erase(waiting_.begin());
  }
  if (live_ && anything) file_.flush();
}

void RunLog::finish() {
  flush(bus::kNever);
  file_.commit();
}

}  // namespace tb

#include "tb/bench/record.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/baud.hpp"
#include "bus/time_text.hpp"

namespace dsdpv1::tb {

const char* name(profibus::Severity severity) {
  switch (severity) {
    case profibus::Severity::kInfo: return "info";
    case profibus::Severity::kRefusal: return "refusal";
    case profibus::Severity::kViolation: return "violation";
  }
  return "";
}

const char* name(profibus::DpState state) {
  switch (state) {
    case profibus::DpState::kOffline: return "OFFLINE";
    case profibus::DpState::kWaitPrm: return "WAIT_PRM";
    case profibus::DpState::kWaitCfg: return "WAIT_CFG";
    case profibus::DpState::kDataExch: return "DATA_EXCH";
  }
  return "";
}

const char* name(ChecksMode mode) {
  switch (mode) {
    case ChecksMode::kFail: return "fail";
    case ChecksMode::kReport: return "report";
    case ChecksMode::kOff: return "off";
  }
  return "";
}

Repeated& Repetitions::entry(const Occurrence& like) {
  Repeated& entry = entries_[{like.station, like.code, like.place}];
  if (entry.count == 0) entry = {like.station, like.code, like.place, {}, 0, 0, 0, like.allowed, {}, like.judged};
  return entry;
}

std::vector<Repeated> Repetitions::list() const {
  std::vector<Repeated> list;
  list.reserve(entries_.size());
  for (const auto& [key, entry] : entries_) list.push_back(entry);
  std::stable_sort(list.begin(), list.end(), [](const Repeated& a, const Repeated& b) { return a.first < b.first; });
  return list;
}

void Tsdr::add(double bits) {
  min_bits = answers == 0 ? bits : std::min(min_bits, bits);
  max_bits = answers == 0 ? bits : std::max(max_bits, bits);
  ++answers;
}

double RunResult::real_time_factor() const {
  return wall_s > 0 ? static_cast<double>(simulated) / static_cast<double>(bus::kTicksPerSecond) / wall_s : 0;
}

std::string place_text(const user_cpu::Place& place) {
  const std::string line =
      place.file.empty() ? fmt::format("at 0x{:08X}", place.pc) : fmt::format("at {}:{}", place.file, place.line);
  const std::string function = place.function.empty() ? "" : fmt::format("in {}()", place.function);
  const std::string joint = function.empty() ? "" : " ";
  if (!place.stayed) return line + joint + function;
  return fmt::format("{}{}{} for {}", function, joint, line, bus::short_time(*place.stayed));
}

std::string with_place(const std::string& text, const std::optional<user_cpu::Place>& place) {
  return place ? text + ", " + place_text(*place) : text;
}

std::string baud_text(std::optional<int> baud) { return baud ? std::string(bus::baud(*baud).name) : "searching"; }

}  // namespace dsdpv1::tb

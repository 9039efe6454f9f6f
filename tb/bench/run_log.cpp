#include "tb/bench/run_log.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "bus/printable.hpp"
#include "bus/time_text.hpp"
#include "io/input/units.hpp"
#include "tb/bench/record.hpp"

namespace dsdpv1::tb {
namespace {

const char* gap_before_bytes(const std::string& kind) {
  if (kind == "telegram" || kind == "host") return "  ";
  return kind == "inputs" ? ": " : " ";
}

std::string text_line(const LogEntry& entry, const LogForm& form, const char* joint) {
  std::string text = entry.code.empty() ? entry.text : entry.code + joint + entry.text;
  if (entry.tsdr_bits) text += fmt::format("  [TSDR {:.2f}]", *entry.tsdr_bits);
  if (!entry.wrong.empty()) text += fmt::format("  [wrong: {}]", entry.wrong);
  if (entry.where) text += fmt::format("  [{}]", place_text(*entry.where));
  if (entry.bytes) text += gap_before_bytes(entry.kind) + bytes_text(*entry.bytes, form.most_bytes());
  return fmt::format("{:>17} ns  {:<12} {:<9} {}\n", nanoseconds(entry.at), entry.station, entry.kind,
                     bus::printable(text));
}

std::string json_line(const LogEntry& entry) {
  nlohmann::ordered_json json;
  json["at_ns"] = std::stod(nanoseconds(entry.at));
  json["station"] = entry.station;
  json["kind"] = entry.kind;
  if (!entry.code.empty()) json["code"] = entry.code;
  json["text"] = entry.text;
  if (entry.tsdr_bits) json["tsdr_bits"] = *entry.tsdr_bits;
  if (!entry.wrong.empty()) json["wrong"] = entry.wrong;
  if (const auto& where = entry.where) {
    nlohmann::ordered_json& place = json["where"];
    place = {{"file", where->file},
             {"line", where->line},
             {"function", where->function},
             {"pc", fmt::format("0x{:08X}", where->pc)}};
    if (where->stayed) place["stayed_ns"] = std::stod(nanoseconds(*where->stayed));
  }
  if (entry.bytes) json["bytes"] = bytes_text(*entry.bytes, entry.bytes->size());
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string nanoseconds(bus::Tick tick) { return bus::nanoseconds_text(tick); }

LogEntry log_entry(const bus::WireTelegram& telegram, const std::string& words) {
  LogEntry entry{telegram.end, "bus", "telegram", words, {}, telegram.decoded.bytes};
  if (telegram.tsdr) entry.tsdr_bits = telegram.tsdr_bits();
  if (telegram.decoded.error != bus::DecodeError::kNone) entry.wrong = bus::describe(telegram.decoded.error);
  if (entry.wrong.empty() && telegram.character_errors) entry.wrong = "character errors";
  return entry;
}

LogForm log_form(const std::string& path, bool whole, bool live, bus::Tick from) {
  constexpr std::string_view kEnding = ".jsonl";
  const bool json =
      path.size() > kEnding.size() && path.compare(path.size() - kEnding.size(), kEnding.size(), kEnding) == 0;
  return {json, whole, from, live};
}

void RunLog::add(const LogEntry& entry) { add(entry, ": ", {}); }

void RunLog::finding(const LogEntry& entry) { add(entry, " ", entry.code + " " + entry.text); }

void RunLog::add(const LogEntry& entry, const char* joint, std::string order) {
  if (entry.at < form_.from) return;
  waiting_.emplace(std::tuple(entry.at, entry.station, std::move(order)),
                   form_.json ? json_line(entry) : text_line(entry, form_, joint));
}

void RunLog::flush(bus::Tick now) {
  const bool anything = !waiting_.empty() && std::get<0>(waiting_.begin()->first) <= now;
  while (!waiting_.empty() && std::get<0>(waiting_.begin()->first) <= now) {
    file_.write(waiting_.begin()->second);
    waiting_.erase(waiting_.begin());
  }
  if (form_.live && anything) file_.flush();
}

void RunLog::finish() {
  flush(bus::kNever);
  file_.commit();
}

}  // namespace dsdpv1::tb

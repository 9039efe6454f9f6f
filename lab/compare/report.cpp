#include "lab/compare/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bus/time_text.hpp"
#include "io/input/suggest.hpp"
#include "io/input/units.hpp"
#include "tb/report/junit.hpp"
#include "tb/report/text_table.hpp"

namespace dsdpv1::tb::compare {
namespace {

constexpr std::size_t kMostRows = 40, kMostNames = 8;

std::string line(const std::string& heading, const std::string& what) {
  return fmt::format("{:<17} {}\n", heading, what);
}

std::string moment(const Result& result, Time at) { return bus::moment_text(result.scale.tick(at)); }

std::string file_text(const Result& result, const FileResult& file) {
  return fmt::format("{}: {} signals, {} to {}{}", file.path, file.signals, moment(result, file.begin),
                     file.ended ? "" : "beyond ", moment(result, file.end));
}

std::string names_text(std::vector<std::string> names) {
  const std::size_t more = names.size() > kMostNames ? names.size() - kMostNames : 0;
  names.resize(names.size() - more);
  return join(names) + (more != 0 ? fmt::format(" and {} more", more) : "");
}

std::uint64_t compared(const Result& result) {
  std::uint64_t sum = 0;
  for (const SignalResult& signal : result.signals) sum += signal.compared;
  return sum;
}

std::string when(const Result& result, Time at) {
  return fmt::format("{}, {}", cycle_text(result.scale.tick(at)), result.scale.text(at));
}

/// The lines of a signal that differs.
std::string found_text(const Result& result, const SignalResult& signal) {
  return fmt::format("{}: A {}, B {}", cycle_text(result.scale.tick(signal.first->at)), signal.first->a,
                     signal.first->b);
}

std::string too_early_text(const Result& result) {
  return fmt::format("at {}, --to is {}", result.scale.text(result.to), result.scale.text(*result.wanted));
}

std::string b_ends_text(const Result& result) {
  return fmt::format("at {}, A {}{}", result.scale.text(result.b.end), result.a.ended ? "at " : "beyond ",
                     result.scale.text(result.a.end));
}

/// Findings beside the values.
std::string remarks(const Result& result) {
  std::string text;
  if (!result.left_out.empty()) text += line("pins left out", names_text(result.left_out));
  if (!result.alone.empty()) text += line("no counterpart", names_text(result.alone));
  if (result.short_of_end()) text += line("ends too early", too_early_text(result));
  if (result.b_ends_first) text += line("B ends too early", b_ends_text(result));
  if (result.first && result.rounded)
    text += line("B is rounded", "its times are multiples of " + result.scale.text(*result.rounded) +
                                     ", which --tolerance can allow for");
  return text;
}

std::string first_text(const Result& result) {
  const SignalResult& signal = result.signals[*result.first];
  const auto together = std::count_if(result.signals.begin(), result.signals.end(), [&](const SignalResult& other) {
    return other.first && other.first->at == signal.first->at;
  });
  std::string text = line("first difference", when(result, signal.first->at));
  text += line("", fmt::format("{}: A {}, B {}{}", signal.name, signal.first->a, signal.first->b,
                               together > 1 ? fmt::format(" (and {} more signals then)", together - 1) : ""));
  for (const Line& each : result.surroundings) text += line(each.first, each.second);
  return text;
}

/// Signals that differ, and the others if there is room.
std::vector<const SignalResult*> rows(const Result& result) {
  std::vector<const SignalResult*> rows;
  for (const bool different : {true, false})
    for (const SignalResult& signal : result.signals)
      if ((signal.differences != 0) == different && rows.size() < kMostRows) rows.push_back(&signal);
  return rows;
}

std::string table(const Result& result) {
  TextTable table({"signal", "compared", "differences", "first"});
  for (const SignalResult* signal : rows(result))
    table.add({signal->name, fmt::format("{}", signal->compared), fmt::format("{}", signal->differences),
               signal->first ? found_text(result, *signal) : "-"});
  const std::size_t left = result.signals.size() - std::min(result.signals.size(), kMostRows);
  return "\n" + table.text() + (left != 0 ? fmt::format("  and {} more signals\n", left) : "") + "\n";
}

std::string window(const Result& result) {
  const std::size_t count = result.signals.size();
  return fmt::format("{} signal{} from {} to {}: {} values{}", count, count == 1 ? "" : "s",
                     moment(result, result.from), moment(result, result.to), compared(result),
                     result.tolerance != 0 ? ", tolerance " + result.scale.text(result.tolerance) : "");
}

nlohmann::ordered_json first_json(const Result& result, const SignalResult& signal) {
  if (!signal.first) return nullptr;
  const Time at = signal.first->at;
  return {{"time", result.scale.text(at)},
          {"ps", result.scale.picoseconds(at)},
          {"cycle", result.scale.tick(at) / kTicksPerCycle},
          {"a", signal.first->a},
          {"b", signal.first->b}};
}

nlohmann::ordered_json file_json(const Result& result, const FileResult& file) {
  return {{"file", file.path},
          {"signals", file.signals},
          {"begin", result.scale.text(file.begin)},
          {"end", result.scale.text(file.end)},
          {"read_to_its_end", file.ended}};
}

}  // namespace

std::string text(const Result& result) {
  std::string text = line("A", file_text(result, result.a)) + line("B", file_text(result, result.b));
  text += line("compared", window(result));
  if (!result.only_a.empty()) text += line("not compared of A", names_text(result.only_a));
  if (!result.only_b.empty()) text += line("not compared of B", names_text(result.only_b));
  text += remarks(result);
  if (result.first) text += first_text(result);
  return text + table(result) + (result.equal() ? "EQUAL\n" : "DIFFERENT\n");
}

std::string json(const Result& result) {
  nlohmann::ordered_json signals = nlohmann::ordered_json::array();
  for (const SignalResult& signal : result.signals)
    signals.push_back({{"signal", signal.name},
                       {"compared", signal.compared},
                       {"differences", signal.differences},
                       {"first", first_json(result, signal)}});
  nlohmann::ordered_json first = nullptr;
  if (result.first) {
    first = first_json(result, result.signals[*result.first]);
    first["signal"] = result.signals[*result.first].name;
    for (const Line& each : result.surroundings) first["then"][each.first] = each.second;
  }
  const nlohmann::ordered_json all = {{"equal", result.equal()},
                                      {"a", file_json(result, result.a)},
                                      {"b", file_json(result, result.b)},
                                      {"from", result.scale.text(result.from)},
                                      {"to", result.scale.text(result.to)},
                                      {"ends_too_early", result.short_of_end()},
                                      {"tolerance", result.scale.text(result.tolerance)},
                                      {"first", first},
                                      {"signals", signals},
                                      {"only_a", result.only_a},
                                      {"only_b", result.only_b},
                                      {"left_out", result.left_out},
                                      {"alone", result.alone},
                                      {"b_ends_first", result.b_ends_first}};
  return all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string junit(const Result& result) {
  const std::string suite = result.a.path + " and " + result.b.path;
  std::vector<JunitCase> cases;
  for (const SignalResult& signal : result.signals) {
    cases.push_back({suite, signal.name, 0, {}, fmt::format("{} values compared", signal.compared)});
    if (signal.first) cases.back().failure = found_text(result, signal);
  }
  if (result.first) cases[*result.first].output = first_text(result);
  if (result.wanted) cases.push_back({suite, "both reach --to", 0, {}, ""});
  if (result.short_of_end()) cases.back().failure = too_early_text(result);
  if (result.strict) cases.push_back({suite, "each signal has a counterpart", 0, {}, ""});
  if (!result.alone.empty()) cases.back().failure = names_text(result.alone);
  if (result.strict) cases.push_back({suite, "B does not end before A", 0, {}, ""});
  if (result.b_ends_first) cases.back().failure = b_ends_text(result);
  return tb::junit("dsdpv1-sim compare", cases);
}

}  // namespace dsdpv1::tb::compare

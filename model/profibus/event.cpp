#include "model/profibus/event.hpp"

#include <algorithm>
#include <iterator>

#include "model/profibus/chip_reasons.hpp"

namespace dsdpv1::profibus {

const ReasonRow detail::kReasonRows[] = {
#define X(id, severity, ...) {Severity::severity, __VA_ARGS__},
#include "model/profibus/reasons.inc"
#undef X
};

ReasonTable reasons() { return {detail::kReasonRows, std::size(detail::kReasonRows)}; }

std::vector<Reason> reasons_of(std::initializer_list<ReasonTable> rooms) {
  std::vector<Reason> all;
  for (const ReasonTable& room : rooms)
    for (const ReasonRow& row : room) all.emplace_back(row);
  return all;
}

namespace {

constexpr const char* kStates[] = {"OFFLINE", "WAIT_PRM", "WAIT_CFG", "DATA_EXCH"};
constexpr const char* kRates[] = {"12M", "6M", "3M", "1.5M", "500k", "187.5k", "93.75k", "45.45k", "19.2k", "9.6k"};

// A row of table 30: each bit of RmEntry::bits implies the one before it.
constexpr const char* kRmStates[] = {"not in use", "in use", "in use, connected", "in use, connected, exchanging"};

// Telegrams that a user judges or takes.
constexpr const char* kBlocks[] = {"Set_Prm", "Check_Cfg", "Set_Slave_Address"};

constexpr std::uint16_t kNone = 0xFFFF;  // kNoSap in 16 bits

// Ticks of 1/12 ns in the unit that leaves 1 to 999: "10.000 ns", "2.700 us".
std::string time_text(unsigned ticks) {
  const bool is_long = ticks >= 12'000;
  const unsigned thousandths = is_long ? (ticks + 6) / 12 : (ticks * 1000 + 6) / 12;
  std::string digits = std::to_string(thousandths);
  if (digits.size() < 4) digits.insert(0, 4 - digits.size(), '0');
  return digits.insert(digits.size() - 3, ".") + (is_long ? " us" : " ns");
}

// `format` is empty for decimal, "4x" for four hexadecimal digits, "ns" for a time, "state", "rate", "rm" and "block"
// for their names, "sap" for a number or "none"; "high" and "low" are the bytes, the low one also as "low2x".
std::string field_text(std::uint16_t value, const std::string& format) {
  if (format.empty()) return std::to_string(value);
  if (format == "ns") return time_text(value);
  if (format == "sap") return value == kNone ? "none" : std::to_string(value);
  if (format == "state") return kStates[value % std::size(kStates)];
  if (format == "rate") return kRates[value % std::size(kRates)];
  if (format == "rm") return kRmStates[(value & 1) + (value >> 1 & 1) + (value >> 2 & 1)];
  if (format == "block") return kBlocks[value % std::size(kBlocks)];
  if (format == "high") return std::to_string(value >> 8);
  if (format.rfind("low", 0) == 0) return field_text(value & 0xFF, format.substr(3));
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string digits;
  for (unsigned rest = value; rest != 0 || digits.size() < static_cast<std::size_t>(format[0] - '0'); rest >>= 4)
    digits.insert(digits.begin(), kDigits[rest & 0xF]);
  return digits;
}

struct NamedWord {
  const char* name;
  const char* Words::*word;
};
constexpr NamedWord kWords[] = {
#define X(name, neutral) {#name, &Words::name},
#include "model/profibus/words.inc"
#undef X
};

// "a", "b:4x": a number of the event; all other fields are words.
bool is_value(const std::string& field) { return field.size() == 1 || field[1] == ':'; }

std::string word_text(const std::string& name, const Words& words) {
  const auto* found =
      std::find_if(std::begin(kWords), std::end(kWords), [&](const NamedWord& w) { return name == w.name; });
  return found == std::end(kWords) ? "{" + name + "}" : words.*found->word;
}

/// Replaces each {field} of `pattern` by `text_of` of it.
template <class TextOf>
std::string fill_in(const std::string& pattern, const TextOf& text_of) {
  std::string filled;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '{') {
      filled += pattern[i];
      continue;
    }
    const std::size_t close = pattern.find('}', i);
    filled += text_of(pattern.substr(i + 1, close - i - 1));
    i = close;
  }
  return filled;
}

std::string with_words(const char* text, const Words& words) {
  return fill_in(
      text, [&](const std::string& field) { return is_value(field) ? "{" + field + "}" : word_text(field, words); });
}

}  // namespace

std::string text_template(Reason reason, const Words& words) { return with_words(reason.row().text, words); }
std::string advice(Reason reason, const Words& words) { return with_words(reason.row().advice, words); }

std::string describe(const Event& event, const Words& words) {
  return fill_in(
      event.reason.row().text,
      [&](const std::string& field) {
        if (!is_value(field)) return word_text(field, words);
        const std::uint16_t value = field[0] == 'a' ? event.a : field[0] == 'b' ? event.b : event.c;
        return field_text(value, field.size() > 2 ? field.substr(2) : "");
      });
}

}  // namespace dsdpv1::profibus

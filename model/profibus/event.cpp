#include "model/profibus/event.hpp"

#include <iterator>

namespace profibus {
namespace {

struct Row {
  Severity severity;
  const char* code;
  const char* text;
  const char* advice;
};

constexpr Row kRows[] = {
#define X(id, severity, code, text, advice) {Severity::severity, code, text, advice},
#include "model/profibus/event_table.inc"
#undef X
};

const Row& row(Reason reason) { return kRows[static_cast<std::size_t>(reason)]; }

constexpr const char* kStates[] = {"OFFLINE", "WAIT_PRM", "WAIT_CFG", "DATA_EXCH"};
constexpr const char* kRates[] = {"12M", "6M", "3M", "1.5M", "500k", "187.5k", "93.75k", "45.45k", "19.2k", "9.6k"};

// A row of table 30: each bit of RmEntry::bits stands on the one before it.
constexpr const char* kRmStates[] = {"not in use", "in use", "in use, connected", "in use, connected, exchanging"};

constexpr std::uint16_t kNone = 0xFFFF;  // kNoSap in 16 bits

// `format` is empty for decimal, "4x" for four hexadecimal digits, "state", "rate" and "rm" for their names, "sap" for
// a number or "none"; "high" and "low" are the bytes, the low one also as "low2x".
std::string field_text(std::uint16_t value, const std::string& format) {
  if (format.empty()) return std::to_string(value);
  if (format == "sap") return value == kNone ? "none" : std::to_string(value);
  if (format == "state") return kStates[value % std::size(kStates)];
  if (format == "rate") return kRates[value % std::size(kRates)];
  if (format == "rm") return kRmStates[(value & 1) + (value >> 1 & 1) + (value >> 2 & 1)];
  if (format == "high") return std::to_string(value >> 8);
  if (format.rfind("low", 0) == 0) return field_text(value & 0xFF, format.substr(3));
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string digits;
  for (unsigned rest = value; rest != 0 || digits.size() < static_cast<std::size_t>(format[0] - '0'); rest >>= 4)
    digits.insert(digits.begin(), kDigits[rest & 0xF]);
  return digits;
}

}  // namespace

const char* code(Reason reason) { return row(reason).code; }
Severity severity(Reason reason) { return row(reason).severity; }
const char* text_template(Reason reason) { return row(reason).text; }
const char* advice(Reason reason) { return row(reason).advice; }
std::size_t reason_count() { return std::size(kRows); }

std::string describe(const Event& event) {
  const std::string pattern = row(event.reason).text;
  std::string words;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '{') {
      words += pattern[i];
      continue;
    }
    const std::size_t close = pattern.find('}', i);
    const std::string field = pattern.substr(i + 1, close - i - 1);
    const std::uint16_t value = field[0] == 'a' ? event.a : field[0] == 'b' ? event.b : event.c;
    words += field_text(value, field.size() > 2 ? field.substr(2) : "");
    i = close;
  }
  return words;
}

}  // namespace profibus

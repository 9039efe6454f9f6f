#include "bus/telegram/telegram_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <istream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "bus/printable.hpp"

namespace dsdpv1::bus {
namespace {

// Limits the memory used for a stream: `decode` reports nothing before it has read everything. 64 MB are 48 s of a full
// bus at 12 Mbit/s.
constexpr std::size_t kLongestLine = 16U << 20U, kMostBytes = 64U << 20U;

bool is_separator(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0 || c == ','; }

/// A word as quoted in an error line.
std::string shortened(const std::string& word) {
  constexpr std::size_t kMost = 40;
  return word.size() <= kMost ? printable(word) : printable(word.substr(0, kMost)) + "...";
}

/// Appends the bytes of one word; returns its fault, or an empty text.
std::string add_word(std::string word, int line, TelegramText& text) {
  const std::string shown = shortened(word);
  if (word.size() > 2 && word[0] == '0' && (word[1] == 'x' || word[1] == 'X')) word.erase(0, 2);
  for (const char c : word)
    if (std::isxdigit(static_cast<unsigned char>(c)) == 0)
      return fmt::format("'{}' is no hexadecimal number, expected bytes of two digits 00 to FF", shown);
  if (word.size() % 2 != 0) return fmt::format("'{}' has an odd number of digits, a byte has two: 00 to FF", shown);
  for (std::size_t i = 0; i < word.size(); i += 2) {
    text.bytes.push_back(static_cast<std::uint8_t>(std::stoul(word.substr(i, 2), nullptr, 16)));
    text.lines.push_back(line);
  }
  return {};
}

std::string add_words(const std::string& content, int line, TelegramText& text) {
  std::size_t at = 0;
  while (at < content.size()) {
    if (is_separator(content[at])) {
      ++at;
      continue;
    }
    std::size_t stop = at;
    while (stop < content.size() && !is_separator(content[stop])) ++stop;
    std::string wrong = add_word(content.substr(at, stop - at), line, text);
    if (!wrong.empty()) return wrong;
    at = stop;
  }
  return {};
}

/// A line of the log: its time, its kind, and the bytes of a telegram.
struct LogLine {
  std::string at_ns, kind, bytes;
  std::size_t whole_length = 0;  ///< 0: all bytes are there
};

/// Removes "... (44 bytes)" at the end of bytes that the log has cut.
void take_off_cut(LogLine& line) {
  const std::size_t cut = line.bytes.find(" ... (");
  if (cut == std::string::npos) return;
  line.whole_length = std::stoul("0" + line.bytes.substr(cut + 6, 4));
  line.bytes.erase(cut);
}

bool is_time(const std::string& word) {
  const std::size_t point = word.find('.');
  return point != std::string::npos && point > 0 && word.size() == point + 4 &&
         word.find_first_not_of("0123456789.") == std::string::npos;
}

/// "   1361750.083 ns  bus          telegram  2 -> 5 ...  68 05"; nullopt for a line that is not of a log.
std::optional<LogLine> text_log_line(const std::string& content) {
  std::istringstream words(content);
  LogLine line;
  std::string unit, station;
  if (!(words >> line.at_ns >> unit >> station >> line.kind) || unit != "ns" || !is_time(line.at_ns))
    return std::nullopt;
  const std::size_t gap = content.rfind("  ");
  if (line.kind == "telegram") line.bytes = content.substr(gap);
  take_off_cut(line);
  return line;
}

/// Reads a JSON line; `error` says what is wrong with it.
std::optional<LogLine> json_log_line(const std::string& content, std::string& error) {
  const auto json = nlohmann::json::parse(content, nullptr, false);
  const auto text = [&json](const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  if (!json.is_object() || text("kind").empty() || !json.contains("at_ns") || !json["at_ns"].is_number()) {
    error = "is no line of a log, expected JSON objects with at_ns and kind, or bytes of two digits 00 to FF";
    return std::nullopt;
  }
  LogLine line{fmt::format("{:.3f}", json["at_ns"].get<double>()), text("kind"), text("bytes")};
  if (line.kind != "telegram") line.bytes.clear();
  return line;
}

std::string add_logged(const LogLine& logged, int line, TelegramText& text) {
  const std::size_t before = text.bytes.size();
  std::string wrong = add_words(logged.bytes, line, text);
  const std::size_t count = text.bytes.size() - before;
  if (count != 0) text.logged[line] = {logged.at_ns, std::max(count, logged.whole_length)};
  return wrong;
}

std::string add_line(const std::string& content, int line, TelegramText& text) {
  const std::size_t first = content.find_first_not_of(" \t");
  std::string error;
  std::optional<LogLine> logged =
      first != std::string::npos && content[first] == '{' ? json_log_line(content, error) : text_log_line(content);
  if (!error.empty()) return error;
  if (logged) return add_logged(*logged, line, text);
  return add_words(content.substr(0, content.find_first_of("#;")), line, text);
}

/// Like std::getline, but stops one character after the limit.
bool get_line(std::istream& in, std::string& line) {
  line.clear();
  for (char c = 0; in.get(c);) {
    if (c == '\n') return true;
    line += c;
    if (line.size() > kLongestLine) return true;
  }
  return !line.empty();
}

std::string add_limited_line(const std::string& content, int line, TelegramText& text) {
  if (content.size() > kLongestLine)
    return fmt::format("is longer than {} MB, expected lines of up to that", kLongestLine >> 20U);
  std::string wrong = add_line(content, line, text);
  if (wrong.empty() && text.bytes.size() > kMostBytes)
    return fmt::format("more than {} MB of telegrams, expected up to that", kMostBytes >> 20U);
  return wrong;
}

}  // namespace

bool TelegramText::together(std::size_t a, std::size_t b) const {
  return lines[a] == lines[b] || (log_of(a) == nullptr && log_of(b) == nullptr);
}

const LoggedTelegram* TelegramText::log_of(std::size_t byte) const {
  const auto found = logged.find(lines[byte]);
  return found == logged.end() ? nullptr : &found->second;
}

bool read_telegram_text(std::istream& in, const std::string& name, TelegramText& text, std::string& error) {
  std::string content;
  for (int line = 1; get_line(in, content); ++line) {
    const std::string wrong = add_limited_line(content, line, text);
    if (wrong.empty()) continue;
    error = fmt::format("{}:{}: {}", name, line, wrong);
    return false;
  }
  if (!in.bad()) return true;
  error = fmt::format("{}:1: cannot be read, a text file of hexadecimal bytes is allowed", name);
  return false;
}

}  // namespace dsdpv1::bus

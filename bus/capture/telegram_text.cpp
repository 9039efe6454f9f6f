#include "bus/capture/telegram_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <istream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>

#include "bus/capture/captured_telegram.hpp"
#include "bus/printable.hpp"

namespace dsdpv1::bus::capture {

namespace {

// Limits the memory used for a stream: `decode` reports nothing before it has read everything. 64 MB are 48 s of a full
// bus at 12 Mbit/s.
constexpr std::size_t kLongestText = 16U << 20U, kMostTextBytes = 64U << 20U;

bool is_separator(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0 || c == ','; }
bool is_digit(char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; }

std::vector<std::string_view> words_of(std::string_view content) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < content.size();) {
    if (is_separator(content[at])) {
      ++at;
      continue;
    }
    std::size_t stop = at;
    while (stop < content.size() && !is_separator(content[stop])) ++stop;
    words.push_back(content.substr(at, stop - at));
    at = stop;
  }
  return words;
}

std::string_view without_prefix(std::string_view word) {
  const bool prefixed = word.size() > 2 && word[0] == '0' && (word[1] == 'x' || word[1] == 'X');
  return prefixed ? word.substr(2) : word;
}

bool is_hexadecimal(std::string_view word) {
  const std::string_view digits = without_prefix(word);
  return std::all_of(digits.begin(), digits.end(), is_digit);
}

bool is_byte(std::string_view word) { return without_prefix(word).size() == 2 && is_hexadecimal(word); }

/// Nothing but bytes, perhaps with a slip: else the line is one of another program's log.
bool is_bytes_alone(const std::vector<std::string_view>& words) {
  return words.empty() || is_byte(words.front()) || std::all_of(words.begin(), words.end(), is_hexadecimal);
}

/// A word as quoted in an error line.
std::string shortened(std::string_view word) {
  constexpr std::size_t kMost = 40;
  return printable(std::string(word.substr(0, kMost))) + (word.size() <= kMost ? "" : "...");
}

/// Reads a text line by line.
class TextLines {
 public:
  explicit TextLines(std::istream& in) : in_(in) {}

  TelegramText read() {
    for (std::string content; get_line(content);) {
      if (content.size() > kLongestText)
        fail(fmt::format("is longer than {} MB, expected lines of up to that", kLongestText >> 20U));
      add_line(content);
      if (text_.bytes.size() > kMostTextBytes)
        fail(fmt::format("more than {} MB of telegrams, expected up to that", kMostTextBytes >> 20U));
    }
    if (in_.bad()) throw CaptureError("cannot be read, a text file of hexadecimal bytes is allowed", 1);
    if (text_.bytes.empty() && words_) throw *words_;
    return std::move(text_);
  }

 private:
  /// A line of the log of dsdpv1-sim: its time, its kind, and the bytes of a telegram.
  struct LogLine {
    std::string at_ns, kind, bytes;
    std::size_t whole_length = 0;  ///< 0: all bytes are there
  };

  [[noreturn]] void fail(const std::string& what) const { throw CaptureError(what, line_); }

  /// Like std::getline, but stops one character after the limit.
  bool get_line(std::string& line) {
    line.clear();
    ++line_;
    for (char c = 0; in_.get(c);) {
      if (c == '\n') return true;
      line += c;
      if (line.size() > kLongestText) return true;
    }
    return !line.empty();
  }

  void add_line(const std::string& content) {
    const std::size_t first = content.find_first_not_of(" \t");
    const bool json = first != std::string::npos && content[first] == '{';
    if (const std::optional<LogLine> logged = json ? json_log_line(content) : text_log_line(content))
      return add_logged(*logged);
    const auto words = words_of(std::string_view(content).substr(0, content.find_first_of("#;")));
    if (is_bytes_alone(words)) return add_words(words);
    add_pasted(words_of(content));
  }

  void add_words(const std::vector<std::string_view>& words) {
    for (const std::string_view word : words) add_word(word);
  }

  void add_word(std::string_view word) {
    const std::string digits(without_prefix(word));
    if (!is_hexadecimal(word)) throw not_hexadecimal(word);
    if (digits.size() % 2 != 0)
      fail(fmt::format("'{}' has an odd number of digits, a byte has two: 00 to FF", shortened(word)));
    for (std::size_t i = 0; i < digits.size(); i += 2) {
      text_.bytes.push_back(static_cast<std::uint8_t>(std::stoul(digits.substr(i, 2), nullptr, 16)));
      text_.lines.push_back(line_);
    }
  }

  CaptureError not_hexadecimal(std::string_view word) const {
    return CaptureError(
        fmt::format("'{}' is no hexadecimal number, expected bytes of two digits 00 to FF", shortened(word)), line_);
  }

  /// "I (394) RX: 68 05 ...": the longest row of bytes is a telegram. Fewer than three are one if they end the line.
  void add_pasted(const std::vector<std::string_view>& words) {
    constexpr std::ptrdiff_t kSurely = 3;  // the shortest telegram but SC
    auto from = words.end(), to = words.end();
    for (auto at = words.begin(); at != words.end();) {
      const auto begin = std::find_if(at, words.end(), is_byte);
      at = std::find_if_not(begin, words.end(), is_byte);
      if (at - begin > to - from) from = begin, to = at;
    }
    if (from == to || (to - from < kSurely && to != words.end())) {
      if (!words_) words_ = not_hexadecimal(words.front());
      return;
    }
    add_words({from, to});
    text_.logged[line_] = {};
  }

  void add_logged(const LogLine& logged) {
    const std::size_t before = text_.bytes.size();
    add_words(words_of(logged.bytes));
    const std::size_t count = text_.bytes.size() - before;
    if (count == 0) return;
    const double ns = std::stod(logged.at_ns);
    text_.logged[line_] = {std::llround(ns * static_cast<double>(kTicksPerNs)), std::max(count, logged.whole_length)};
  }

  /// "   1361750.083 ns  bus          telegram  2 -> 5 ...  68 05"; nullopt for a line that is not of a log.
  static std::optional<LogLine> text_log_line(const std::string& content) {
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

  static bool is_time(const std::string& word) {
    constexpr std::size_t kLongest = 20;
    const std::size_t point = word.find('.');
    return point != std::string::npos && point > 0 && word.size() == point + 4 && word.size() <= kLongest &&
           word.find_first_not_of("0123456789.") == std::string::npos;
  }

  /// Removes "... (44 bytes)" at the end of bytes that the log has cut.
  static void take_off_cut(LogLine& line) {
    const std::size_t cut = line.bytes.find(" ... (");
    if (cut == std::string::npos) return;
    line.whole_length = std::stoul("0" + line.bytes.substr(cut + 6, 4));
    line.bytes.erase(cut);
  }

  LogLine json_log_line(const std::string& content) const {
    constexpr double kLongestNs = 1e17;  // three years
    const auto json = nlohmann::json::parse(content, nullptr, false);
    const auto text = [&json](const char* key) {
      const auto found = json.find(key);
      return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
    };
    const bool timed = json.is_object() && json.contains("at_ns") && json["at_ns"].is_number();
    if (!timed || text("kind").empty() || std::abs(json["at_ns"].get<double>()) > kLongestNs)
      fail("is no line of a log, expected JSON objects with at_ns and kind, or bytes of two digits 00 to FF");
    LogLine line{fmt::format("{:.3f}", json["at_ns"].get<double>()), text("kind"), text("bytes")};
    if (line.kind != "telegram") line.bytes.clear();
    return line;
  }

  std::istream& in_;
  TelegramText text_;
  std::optional<CaptureError> words_;  ///< of the first line without bytes, for a text that has none at all
  int line_ = 0;
};

}  // namespace

bool TelegramText::together(std::size_t a, std::size_t b) const {
  return lines[a] == lines[b] || (log_of(a) == nullptr && log_of(b) == nullptr);
}

const LoggedTelegram* TelegramText::log_of(std::size_t byte) const {
  const auto found = logged.find(lines[byte]);
  return found == logged.end() ? nullptr : &found->second;
}

TelegramText read_telegram_text(std::istream& in) { return TextLines(in).read(); }

}  // namespace dsdpv1::bus::capture

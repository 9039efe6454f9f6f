// Telegrams as hexadecimal text: what `dsdpv1-sim decode` reads and prints.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <istream>
#include <ostream>

#include "bus/explain.hpp"

namespace bus {

namespace {

struct TextBytes {
  Bytes bytes;
  std::vector<int> lines;  ///< the line of each byte
};

bool is_separator(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0 || c == ','; }

/// Appends the bytes of one word; what is wrong with it, or empty.
std::string add_word(std::string word, int line, TextBytes& text) {
  const std::string shown = word;
  if (word.size() > 2 && word[0] == '0' && (word[1] == 'x' || word[1] == 'X')) word.erase(0, 2);
  for (const char c : word) {
    if (std::isxdigit(static_cast<unsigned char>(c)) == 0) {
      return fmt::format("'{}' is no hexadecimal number, allowed are bytes of two digits 00 to FF", shown);
    }
  }
  if (word.size() % 2 != 0) return fmt::format("'{}' has an odd number of digits, a byte has two: 00 to FF", shown);
  for (std::size_t i = 0; i < word.size(); i += 2) {
    text.bytes.push_back(static_cast<std::uint8_t>(std::stoul(word.substr(i, 2), nullptr, 16)));
    text.lines.push_back(line);
  }
  return {};
}

std::string add_line(const std::string& content, int line, TextBytes& text) {
  const std::size_t end = std::min(content.find_first_of("#;"), content.size());
  std::size_t at = 0;
  while (at < end) {
    if (is_separator(content[at])) {
      ++at;
      continue;
    }
    std::size_t stop = at;
    while (stop < end && !is_separator(content[stop])) ++stop;
    std::string wrong = add_word(content.substr(at, stop - at), line, text);
    if (!wrong.empty()) return wrong;
    at = stop;
  }
  return {};
}

bool read_text(std::istream& in, const std::string& name, TextBytes& text, std::string& error) {
  std::string content;
  for (int line = 1; std::getline(in, content); ++line) {
    const std::string wrong = add_line(content, line, text);
    if (wrong.empty()) continue;
    error = fmt::format("{}:{}: {}", name, line, wrong);
    return false;
  }
  if (!in.bad()) return true;
  error = fmt::format("{}:1: cannot be read, a text file of hexadecimal bytes is allowed", name);
  return false;
}

class TextDecoder {
 public:
  TextDecoder(const TextBytes& text, std::ostream& out) : text_(text), out_(out) {}

  /// True when everything was right and there was something.
  bool decode() {
    std::size_t at = 0;
    while (at < text_.bytes.size()) at = decode_one(at);
    if (text_.bytes.empty()) out_ << "no telegram\n";
    return right_ && !text_.bytes.empty();
  }

 private:
  Decoded decode_at(std::size_t at) const {
    TelegramDecoder decoder;
    for (; at < text_.bytes.size(); ++at) {
      if (auto decoded = decoder.feed(text_.bytes[at])) return *decoded;
    }
    return *decoder.finish();
  }

  std::size_t decode_one(std::size_t at) {
    Decoded decoded = decode_at(at);
    if (decoded.error == DecodeError::kNone) {
      print(at, fmt::format("telegram {}", ++count_), explain_line(decoded.telegram), explain_bytes(decoded));
      return at + decoded.bytes.size();
    }
    right_ = false;
    const std::size_t end = end_of_wrong(at, decoded);
    if (decoded.error == DecodeError::kStartDelimiter) {
      print_garbage(at, end);
    } else {
      print_wrong(at, end, decoded);
    }
    return end;
  }

  /// Where to go on behind a wrong telegram. Its inside may hold any byte, so that there only a telegram with a right FCS or one
  /// at the beginning of a line is believed; between telegrams also a token or SC.
  std::size_t end_of_wrong(std::size_t at, const Decoded& decoded) const {
    const bool whole = decoded.readable || decoded.error == DecodeError::kMissingSap;
    const std::size_t limit = whole ? at + decoded.bytes.size() : text_.bytes.size();
    const bool between = decoded.error == DecodeError::kStartDelimiter;
    for (std::size_t i = at + 1; i < limit; ++i) {
      const bool new_line = text_.lines[i] != text_.lines[i - 1];
      if (right_telegram_at(i, between || new_line)) return i;
    }
    return limit;
  }

  bool right_telegram_at(std::size_t at, bool without_fcs) const {
    const Decoded decoded = decode_at(at);
    if (decoded.error != DecodeError::kNone) return false;
    const TelegramKind kind = decoded.telegram.kind;
    return without_fcs || (kind != TelegramKind::kSd4 && kind != TelegramKind::kSc);
  }

  void print_wrong(std::size_t at, std::size_t end, Decoded decoded) {
    if (decoded.bytes.size() > end - at) {  // the telegram was cut off by the next one
      decoded.bytes.resize(end - at);
      decoded.error = DecodeError::kTruncated;
      decoded.readable = false;
    }
    std::vector<ExplainedByte> bytes = explain_bytes(decoded);
    for (std::size_t i = bytes.size(); i < end - at; ++i) bytes.push_back({i, text_.bytes[at + i], "not decoded"});
    print(at, "wrong telegram", describe(decoded.error), bytes);
  }

  void print_garbage(std::size_t at, std::size_t end) {
    std::vector<ExplainedByte> bytes;
    for (std::size_t i = at; i < end; ++i) bytes.push_back({i - at, text_.bytes[i], "garbage"});
    print(at, "garbage", fmt::format("{} {} between telegrams", end - at, end - at == 1 ? "byte" : "bytes"), bytes);
  }

  void print(std::size_t at, const std::string& what, const std::string& line,
             const std::vector<ExplainedByte>& bytes) {
    out_ << fmt::format("{}, line {}: {}\n", what, text_.lines[at], line);
    for (const ExplainedByte& byte : bytes)
      out_ << fmt::format("  {:4}  {:02X}  {}\n", byte.offset, byte.byte, byte.meaning);
  }

  const TextBytes& text_;
  std::ostream& out_;
  int count_ = 0;
  bool right_ = true;
};

}  // namespace

int decode_text(std::istream& in, const std::string& name, std::ostream& out, std::string& error) {
  TextBytes text;
  if (!read_text(in, name, text, error)) return 2;
  return TextDecoder(text, out).decode() ? 0 : 1;
}

}  // namespace bus

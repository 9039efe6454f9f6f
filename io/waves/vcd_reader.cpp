#include "io/waves/vcd_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "io/waves/level_text.hpp"
#include "io/waves/vcd_declarations.hpp"

namespace dsdpv1::tb {
namespace {

/// The byte of an octal or hexadecimal escape, as the characters after the backslash; `at` moves past them.
char numbered_escape(std::string_view text, std::size_t& at) {
  const bool hexadecimal = text[at] == 'x';
  const std::size_t begin = at + (hexadecimal ? 1 : 0);
  const char* const last = text.data() + std::min(text.size(), begin + (hexadecimal ? 2 : 3));
  unsigned value = 0;
  const auto [end, error] = std::from_chars(text.data() + begin, last, value, hexadecimal ? 16 : 8);
  if (error != std::errc()) return '\\';
  at = static_cast<std::size_t>(end - text.data());
  return static_cast<char>(value);
}

/// Blanks and other characters that a word of a VCD cannot have are escaped as in C.
void unescape(std::string& text) {
  constexpr std::string_view kNamed = "abfnrtv\\'\"?", kMeant = "\a\b\f\n\r\t\v\\'\"?";
  if (text.find('\\') == std::string::npos) return;
  std::string plain;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at++];
    const std::size_t named = c == '\\' && at < text.size() ? kNamed.find(text[at]) : std::string_view::npos;
    if (named != std::string_view::npos) ++at;
    plain += named != std::string_view::npos ? kMeant[named]
             : c == '\\' && at < text.size() ? numbered_escape(text, at)
                                             : c;
  }
  text = std::move(plain);
}

}  // namespace

VcdReader::VcdReader(const std::string& path) : text_(path) {
  declarations_.exponent = -9;  // the default
  VcdDeclarations(text_, declarations_, codes_).read();
  selected_.assign(declarations_.signals.size(), true);
}

bool VcdReader::next(WaveEvent& event) {
  for (;;) {
    const std::string_view word = text_.token();
    if (word.empty()) return false;
    bool told = false;
    switch (word.front()) {
      case '#': move_to(word.substr(1)); break;
      case 'b':
      case 'B': told = vector(word.substr(1), event); break;
      case 'r':
      case 'R':
      case 's':
      case 'S': told = word_value(word.substr(1), event); break;
      case '$': told = command(word, event); break;
      default: told = scalar(word, event);
    }
    if (told) return true;
  }
}

void VcdReader::move_to(std::string_view digits) {
  std::uint64_t time = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), time);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size())
    text_.fail("\"#" + std::string(digits.substr(0, 40)) + "\" is no time, expected # and a number of 64 bits");
  if (begin_ && time < now_)
    text_.fail("time " + std::to_string(time) + " comes after " + std::to_string(now_) +
               ", expected times that do not decrease");
  if (!begin_) begin_ = now_ = time;
  if (time != now_) before_end_ = {text_.offset() - digits.size() - 1, now_};
  now_ = time;
}

bool VcdReader::command(std::string_view word, WaveEvent& event) {
  if (word == "$dumpoff" || word == "$dumpon") {
    event = {word == "$dumpon" ? WaveEvent::Kind::kOn : WaveEvent::Kind::kOff, now_, 0, {}};
    return true;
  }
  if (word == "$end" || word == "$dumpvars" || word == "$dumpall") return false;
  if (word != "$comment" && word != "$vcdclose" && word != "$date" && word != "$version") refuse(word);
  for (std::string_view next = text_.token(); next != "$end"; next = text_.token())
    if (next.empty()) text_.fail("ends within " + std::string(word) + ", expected a complete VCD");
  return false;
}

bool VcdReader::scalar(std::string_view word, WaveEvent& event) {
  const char level = level_of(word.front());
  if (level == '\0' || word.size() < 2) refuse(word);
  const std::uint32_t place = signal(word.substr(1));
  if (!selected_[place]) return false;
  const WaveSignal& declared = declarations_.signals[place];
  if (declared.kind == WaveKind::kEvent) return trigger(level, place, event);
  if (declared.kind != WaveKind::kBits) refuse(word);
  if (declared.width != 1) return tell(event, place, extended(word.substr(0, 1), declared.width));
  value_.assign(1, level);
  return tell(event, place, value_);
}

bool VcdReader::vector(std::string_view word, WaveEvent& event) {
  value_ = word;  // the next token may move the text
  const std::uint32_t place = signal(text_.token());
  if (!selected_[place]) return false;
  const WaveSignal& declared = declarations_.signals[place];
  if (declared.kind != WaveKind::kBits || value_.empty()) refuse("b" + value_);
  return tell(event, place, extended(value_, declared.width));
}

/// A real or a string, whose values can be empty.
bool VcdReader::word_value(std::string_view word, WaveEvent& event) {
  value_ = word;
  const std::uint32_t place = signal(text_.token());
  if (!selected_[place]) return false;
  const WaveKind kind = declarations_.signals[place].kind;
  if (kind != WaveKind::kReal && kind != WaveKind::kText) refuse(value_);
  if (kind == WaveKind::kText) unescape(value_);
  return tell(event, place, value_);
}

bool VcdReader::trigger(char level, std::uint32_t signal, WaveEvent& event) const {
  event = {WaveEvent::Kind::kTrigger, now_, signal, {}};
  return level == '1';
}

std::uint32_t VcdReader::signal(std::string_view code) const {
  const std::uint32_t place = codes_.find(code);
  if (text_.at_bare_end() && codes_.begins_another(code)) text_.fail("");
  if (place == VcdCodes::kNone || code.empty())
    text_.fail("a value of \"" + std::string(code.substr(0, 40)) + "\", expected the codes that $var declares");
  return place;
}

/// 18.2.1: 0 before a leftmost 0 or 1, else the leftmost again.
std::string_view VcdReader::extended(std::string_view bits, std::uint32_t width) {
  const std::size_t given = std::min<std::size_t>(bits.size(), width), before = width - given;
  levels_.resize(width);
  for (std::size_t i = 0; i < given; ++i) {
    levels_[before + i] = level_of(bits[bits.size() - given + i]);
    if (levels_[before + i] == '\0') refuse("b" + std::string(bits));
  }
  const char leftmost = levels_[before];
  std::fill_n(levels_.begin(), before, leftmost == '1' ? '0' : leftmost);
  return levels_;
}

bool VcdReader::tell(WaveEvent& event, std::uint32_t signal, std::string_view value) const {
  event = {WaveEvent::Kind::kChange, now_, signal, value};
  return true;
}

void VcdReader::refuse(std::string_view word) const {
  text_.fail("\"" + std::string(word.substr(0, 40)) +
             "\" is no change, expected #TIME, 0 1 x z with a code, b..., r... or s... and a code, $dump...");
}

}  // namespace dsdpv1::tb

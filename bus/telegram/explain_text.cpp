// Telegrams as hexadecimal text: what `dsdpv1-sim decode` reads and prints.
#include <fmt/format.h>

#include <array>
#include <istream>
#include <optional>
#include <ostream>

#include "bus/telegram/explain.hpp"
#include "bus/telegram/telegram_text.hpp"

namespace bus {

namespace {

class TextDecoder {
 public:
  TextDecoder(const TelegramText& text, std::ostream& out) : text_(text), out_(out) {}

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
    for (const std::size_t first = at; at < text_.bytes.size() && text_.together(first, at); ++at)
      if (auto decoded = decoder.feed(text_.bytes[at])) return *decoded;
    return *decoder.finish();
  }

  std::size_t decode_one(std::size_t at) {
    Decoded decoded = decode_at(at);
    if (decoded.error == DecodeError::kNone) {
      const Telegram& telegram = decoded.telegram;
      if (const std::optional<bool> dpv1 = dpv1_enabled(telegram)) dpv1_.at(telegram.da) = dpv1;
      print(at, fmt::format("telegram {}", ++count_), explain_line(telegram),
            explain_bytes(decoded, dpv1_of(telegram)));
      return at + decoded.bytes.size();
    }
    right_ = false;
    const std::size_t end = end_of_wrong(at, decoded);
    if (decoded.error == DecodeError::kStartDelimiter)
      print_garbage(at, end);
    else
      print_wrong(at, end, decoded);
    return end;
  }

  /// Of the slave that has sent the telegram, as far as its Set_Prm was seen.
  std::optional<bool> dpv1_of(const Telegram& telegram) const { return dpv1_.at(telegram.sa); }

  std::size_t end_of_stream(std::size_t at) const {
    std::size_t end = at + 1;
    while (end < text_.bytes.size() && text_.together(at, end)) ++end;
    return end;
  }

  /// Where to go on behind a wrong telegram. Its inside may hold any byte, so that there only a telegram with a right
  /// FCS or one at the beginning of a line is believed; between telegrams also a token or SC.
  std::size_t end_of_wrong(std::size_t at, const Decoded& decoded) const {
    const bool whole = decoded.readable || decoded.error == DecodeError::kMissingSap;
    const std::size_t limit = whole ? at + decoded.bytes.size() : end_of_stream(at);
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
    print(at, "wrong telegram", what_is_wrong(at, decoded), bytes);
  }

  std::string what_is_wrong(std::size_t at, const Decoded& decoded) const {
    const LoggedTelegram* log = text_.log_of(at);
    if (log == nullptr || log->whole_length <= decoded.bytes.size()) return describe(decoded.error);
    return fmt::format("the log has {} of its {} bytes, all of them with --log-whole or --log FILE.jsonl",
                       decoded.bytes.size(), log->whole_length);
  }

  void print_garbage(std::size_t at, std::size_t end) {
    std::vector<ExplainedByte> bytes;
    for (std::size_t i = at; i < end; ++i) bytes.push_back({i - at, text_.bytes[i], "garbage"});
    print(at, "garbage", fmt::format("{} {} between telegrams", end - at, end - at == 1 ? "byte" : "bytes"), bytes);
  }

  void print(std::size_t at, const std::string& what, const std::string& line,
             const std::vector<ExplainedByte>& bytes) {
    const LoggedTelegram* log = text_.log_of(at);
    out_ << fmt::format("{}, line {}{}: {}\n", what, text_.lines[at], log ? ", " + log->at_ns + " ns" : "", line);
    for (const ExplainedByte& byte : bytes)
      out_ << fmt::format("  {:4}  {:02X}  {}\n", byte.offset, byte.byte, byte.meaning);
  }

  const TelegramText& text_;
  std::array<std::optional<bool>, 128> dpv1_ = {};  ///< by slave
  std::ostream& out_;
  int count_ = 0;
  bool right_ = true;
};

}  // namespace

int decode_text(std::istream& in, const std::string& name, std::ostream& out, std::string& error) {
  TelegramText text;
  if (!read_telegram_text(in, name, text, error)) return 2;
  return TextDecoder(text, out).decode() ? 0 : 1;
}

}  // namespace bus

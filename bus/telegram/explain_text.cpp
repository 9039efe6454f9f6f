// Telegrams as hexadecimal text: input and output of `dsdpv1-sim decode`.
#include <fmt/format.h>

#include <istream>
#include <ostream>

#include "bus/telegram/explain.hpp"
#include "bus/telegram/telegram_printer.hpp"
#include "bus/telegram/telegram_text.hpp"

namespace dsdpv1::bus {

namespace {

class TextDecoder {
 public:
  TextDecoder(const TelegramText& text, std::ostream& out) : text_(text), printer_(out), out_(out) {}

  /// Returns true if there was a telegram and no fault.
  bool decode() {
    std::size_t at = 0;
    while (at < text_.bytes.size()) at = decode_one(at);
    if (text_.bytes.empty()) out_ << "no telegram\n";
    return printer_.all_right();
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
      printer_.right(where(at), decoded);
      return at + decoded.bytes.size();
    }
    const std::size_t end = end_of_wrong(at, decoded);
    if (decoded.error == DecodeError::kStartDelimiter)
      printer_.garbage(where(at), bytes(at, end));
    else
      print_wrong(at, end, decoded);
    return end;
  }

  std::size_t end_of_stream(std::size_t at) const {
    std::size_t end = at + 1;
    while (end < text_.bytes.size() && text_.together(at, end)) ++end;
    return end;
  }

  /// Where to continue after an invalid telegram. It may contain any byte, so only a telegram with a right FCS or
  /// one at the beginning of a line is accepted there; between telegrams also a token or SC.
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
    if (decoded.bytes.size() > end - at) {  // the next telegram cut it off
      decoded.bytes.resize(end - at);
      decoded.error = DecodeError::kTruncated;
      decoded.readable = false;
    }
    printer_.wrong(where(at), what_is_wrong(at, decoded), decoded, bytes(at, end));
  }

  std::string what_is_wrong(std::size_t at, const Decoded& decoded) const {
    const LoggedTelegram* log = text_.log_of(at);
    if (log == nullptr || log->whole_length <= decoded.bytes.size()) return describe(decoded.error);
    return fmt::format("the log has {} of its {} bytes, all of them with --log-whole or --log FILE.jsonl",
                       decoded.bytes.size(), log->whole_length);
  }

  Bytes bytes(std::size_t from, std::size_t to) const {
    const auto at = [this](std::size_t i) { return text_.bytes.begin() + static_cast<std::ptrdiff_t>(i); };
    return {at(from), at(to)};
  }

  std::string where(std::size_t at) const {
    const LoggedTelegram* log = text_.log_of(at);
    return fmt::format("line {}{}", text_.lines[at], log != nullptr ? ", " + log->at_ns + " ns" : "");
  }

  const TelegramText& text_;
  TelegramPrinter printer_;
  std::ostream& out_;
};

}  // namespace

int decode_text(std::istream& in, const std::string& name, std::ostream& out, std::string& error) {
  TelegramText text;
  if (!read_telegram_text(in, name, text, error)) return 2;
  return TextDecoder(text, out).decode() ? 0 : 1;
}

}  // namespace dsdpv1::bus

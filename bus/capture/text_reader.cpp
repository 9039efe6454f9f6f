#include "bus/capture/text_reader.hpp"

#include <utility>

#include "bus/baud.hpp"
#include "bus/capture/telegram_text.hpp"
#include "bus/telegram/telegram.hpp"

namespace dsdpv1::bus::capture {

namespace {

/// Divides bytes into telegrams.
class Divider {
 public:
  explicit Divider(const TelegramText& text) : text_(text) {}

  /// The end of the telegram at `at`, right or wrong, or of the bytes without one.
  std::size_t end_of(std::size_t at) const {
    const Decoded decoded = decode_at(at);
    return decoded.error == DecodeError::kNone ? at + decoded.bytes.size() : end_of_wrong(at, decoded);
  }

 private:
  Decoded decode_at(std::size_t at) const {
    TelegramDecoder decoder;
    for (const std::size_t first = at; at < text_.bytes.size() && text_.together(first, at); ++at)
      if (auto decoded = decoder.feed(text_.bytes[at])) return *decoded;
    return *decoder.finish();
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

  const TelegramText& text_;
};

/// Places telegrams in time.
class Layout {
 public:
  explicit Layout(std::optional<int> baud) : baud_(baud) {}

  void place(CapturedTelegram& telegram, const LoggedTelegram* log) {
    telegram.baud = baud_;
    telegram.timed = baud_.has_value() || (log != nullptr && log->at);
    if (!telegram.timed) return;
    const Tick bit = baud_ ? bus::baud(*baud_).bit : 0;
    const Tick length = static_cast<Tick>(telegram.bytes.size()) * kCharacterBits * bit;
    telegram.end = log != nullptr && log->at ? *log->at : end_ + idle_before(telegram) * bit + length;
    telegram.start = telegram.end - length;
    end_ = telegram.end;
  }

 private:
  /// Bit times.
  Tick idle_before(const CapturedTelegram& telegram) {
    constexpr Tick kIdle = 37;  // T_ID1 of BusParameters: T_SYN, the safety margin
    const Decoded decoded = decode(telegram.bytes);
    const bool answer = asked_ && decoded.readable && decoded.telegram.is_response();
    asked_ = decoded.readable && decoded.telegram.wants_answer();
    return answer ? kMinTsdrBits : kIdle;
  }

  std::optional<int> baud_;
  Tick end_ = 0;
  bool asked_ = false;
};

}  // namespace

void read_text(std::istream& in, std::optional<int> baud, const TakeTelegram& take) {
  const TelegramText text = read_telegram_text(in);
  const Divider divider(text);
  Layout layout(baud);
  const auto byte = [&text](std::size_t i) { return text.bytes.begin() + static_cast<std::ptrdiff_t>(i); };
  for (std::size_t at = 0; at < text.bytes.size();) {
    const std::size_t end = divider.end_of(at);
    CapturedTelegram telegram;
    telegram.bytes = {byte(at), byte(end)};
    telegram.line = text.lines[at];
    const LoggedTelegram* log = text.log_of(at);
    if (log != nullptr && log->whole_length > telegram.bytes.size())
      telegram.missing = log->whole_length - telegram.bytes.size();
    layout.place(telegram, log);
    take(telegram);
    at = end;
  }
}

}  // namespace dsdpv1::bus::capture

#include "bus/capture/telegram_printer.hpp"

#include <fmt/format.h>

#include <ostream>

#include "bus/printable.hpp"
#include "bus/time_text.hpp"

namespace dsdpv1::bus::capture {

std::string what_is_wrong(const CapturedTelegram& telegram, const Decoded& decoded) {
  if (telegram.missing != 0) {
    const std::size_t there = telegram.bytes.size();
    return fmt::format("the log has {} of its {} bytes, all of them with --log-whole or --log FILE.jsonl", there,
                       there + telegram.missing);
  }
  if (telegram.bytes.empty()) return "no character";
  std::string why;
  if (decoded.error != DecodeError::kNone)
    why = describe(decoded.error);
  else if (decoded.bytes.size() < telegram.bytes.size())
    why = "more bytes than one telegram has";
  const std::string damage = damage_words(telegram.damage & damage::kCharacter);
  return damage.empty() ? why : why.empty() ? damage : damage + ", " + why;
}

void TelegramPrinter::print(const CapturedTelegram& telegram, const Decoded& decoded, const std::string& why,
                            const ExplainContext& context) {
  ++taken_;
  if (telegram.bytes.empty() || (telegram.line != 0 && decoded.error == DecodeError::kStartDelimiter))
    garbage(where(telegram), telegram.bytes);
  else if (why.empty())
    right(where(telegram), decoded, context);
  else
    wrong(where(telegram), why, decoded, telegram.bytes);
  for (const std::string& remark : telegram.remarks) out_ << "        " << printable(remark) << "\n";
}

std::string TelegramPrinter::where(const CapturedTelegram& telegram) const {
  std::string place;
  if (packets_)
    place = fmt::format("packet {}", taken_);
  else if (telegram.line != 0)
    place = fmt::format("line {}", telegram.line);
  if (!telegram.timed) return place;
  return fmt::format("{}{}{} ns", place, place.empty() ? "" : ", ", nanoseconds_text(telegram.start));
}

void TelegramPrinter::right(const std::string& where, const Decoded& decoded, const ExplainContext& context) {
  write(fmt::format("telegram {}", ++right_), where, explain_line(decoded.telegram, context),
        explain_bytes(decoded, context));
}

void TelegramPrinter::wrong(const std::string& where, const std::string& why, const Decoded& decoded,
                            const Bytes& all) {
  std::vector<ExplainedByte> bytes = explain_bytes(decoded);
  for (std::size_t i = bytes.size(); i < all.size(); ++i) bytes.push_back({i, all[i], "not decoded"});
  write("wrong telegram", where, why, bytes);
}

void TelegramPrinter::garbage(const std::string& where, const Bytes& bytes) {
  std::vector<ExplainedByte> words;
  for (std::size_t i = 0; i < bytes.size(); ++i) words.push_back({i, bytes[i], "garbage"});
  write("garbage", where, fmt::format("{} {} between telegrams", bytes.size(), bytes.size() == 1 ? "byte" : "bytes"),
        words);
}

void TelegramPrinter::write(const std::string& what, const std::string& where, const std::string& line,
                            const std::vector<ExplainedByte>& bytes) {
  out_ << fmt::format("{}, {}: {}\n", what, where, line);
  for (const ExplainedByte& byte : bytes)
    out_ << fmt::format("  {:4}  {:02X}  {}\n", byte.offset, byte.byte, byte.meaning);
}

}  // namespace dsdpv1::bus::capture

#include "bus/telegram/telegram_printer.hpp"

#include <fmt/format.h>

#include <ostream>

namespace dsdpv1::bus {

void TelegramPrinter::right(const std::string& where, const Decoded& decoded) {
  const Telegram& telegram = decoded.telegram;
  if (const std::optional<bool> dpv1 = dpv1_enabled(telegram)) dpv1_.at(telegram.da) = dpv1;
  print(fmt::format("telegram {}", ++count_), where, explain_line(telegram),
        explain_bytes(decoded, dpv1_.at(telegram.sa)));
}

void TelegramPrinter::wrong(const std::string& where, const std::string& why, const Decoded& decoded,
                            const Bytes& all) {
  right_ = false;
  std::vector<ExplainedByte> bytes = explain_bytes(decoded);
  for (std::size_t i = bytes.size(); i < all.size(); ++i) bytes.push_back({i, all[i], "not decoded"});
  print("wrong telegram", where, why, bytes);
}

void TelegramPrinter::garbage(const std::string& where, const Bytes& bytes) {
  right_ = false;
  std::vector<ExplainedByte> words;
  for (std::size_t i = 0; i < bytes.size(); ++i) words.push_back({i, bytes[i], "garbage"});
  print("garbage", where, fmt::format("{} {} between telegrams", bytes.size(), bytes.size() == 1 ? "byte" : "bytes"),
        words);
}

void TelegramPrinter::print(const std::string& what, const std::string& where, const std::string& line,
                            const std::vector<ExplainedByte>& bytes) {
  out_ << fmt::format("{}, {}: {}\n", what, where, line);
  for (const ExplainedByte& byte : bytes)
    out_ << fmt::format("  {:4}  {:02X}  {}\n", byte.offset, byte.byte, byte.meaning);
}

}  // namespace dsdpv1::bus

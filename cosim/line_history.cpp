#include "cosim/line_history.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/telegram/explain.hpp"
#include "bus/telegram/telegram.hpp"
#include "bus/wire/uart.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr std::size_t kEdges = 6000;  // more than the longest telegram has

std::string bytes_text(const bus::Bytes& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) text += fmt::format("{}{:02X}", text.empty() ? "" : " ", byte);
  return text;
}

/// Reads characters from the edges of a line and keeps the telegram that began last.
class LineReader {
 public:
  explicit LineReader(int rate) : bit_(bus::baud(rate).bit) {
    receiver_.set_bit(bit_);
    receiver_.reset(true);
    receiver_.on_character = [this](const bus::ReceivedCharacter& each) { character(each); };
  }
  void edge(Tick at, bool level) {
    run(at - 1);
    receiver_.line_changed(at, level);
  }
  void run(Tick until) {
    while (receiver_.next() <= until) receiver_.run(receiver_.next());
  }
  LineTelegram telegram() const {
    if (bytes_.empty()) return {};
    return {start_, fmt::format("{} ({})", words_.empty() ? "not readable" : words_, bytes_text(bytes_))};
  }

 private:
  void character(const bus::ReceivedCharacter& each) {
    constexpr Tick kSynBits = 33;
    if (bytes_.empty() || complete_ || each.start - last_end_ >= (kSynBits - 1) * bit_) {
      decoder_ = {};
      bytes_.clear();
      words_.clear();
      start_ = each.start;
    }
    last_end_ = each.end;
    bytes_.push_back(each.byte);
    const auto decoded = decoder_.feed(each.byte);
    complete_ = decoded.has_value();
    if (decoded && decoded->readable) words_ = bus::explain_line(decoded->telegram);
    if (decoded && decoded->error != bus::DecodeError::kNone)
      words_ += fmt::format("{}{}", words_.empty() ? "" : ", ", bus::describe(decoded->error));
  }

  Tick bit_, start_ = 0, last_end_ = 0;
  bus::UartReceiver receiver_;
  bus::TelegramDecoder decoder_;
  bus::Bytes bytes_;
  std::string words_;
  bool complete_ = false;
};

}  // namespace

void LineHistory::add(Tick at, bool level) {
  edges_.push_back({at, level});
  if (edges_.size() > kEdges) edges_.pop_front();
}

LineTelegram LineHistory::last_telegram(int rate, Tick until) const {
  if (edges_.empty()) return {};
  LineReader reader(rate >= 0 && rate < static_cast<int>(bus::kBauds.size()) ? rate : likely_rate());
  for (const Edge& edge : edges_) reader.edge(edge.at, edge.level);
  reader.run(std::min(until, edges_.back().at + 11 * bus::baud(9).bit));
  return reader.telegram();
}

int LineHistory::likely_rate() const {
  Tick shortest = bus::baud(9).bit;
  for (std::size_t i = 1; i < edges_.size(); ++i) shortest = std::min(shortest, edges_[i].at - edges_[i - 1].at);
  int rate = 9;
  while (rate > 0 && bus::baud(rate).bit > shortest + shortest / 4) --rate;
  return rate;
}

}  // namespace dsdpv1::cosim

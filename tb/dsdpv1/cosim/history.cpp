#include "tb/dsdpv1/cosim/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "bus/telegram/explain.hpp"
#include "bus/telegram/telegram.hpp"
#include "bus/wire/uart.hpp"
#include "tb/waves/wave_writer.hpp"

namespace cosim {
namespace {

constexpr std::size_t kLineEdges = 6000;  // more than the longest telegram has
constexpr std::array<const char*, kSides> kScopes = {"inputs", "model", "rtl"};

bool belongs(Side side, Pin pin) { return dsdpv1::is_input(pin) == (side == Side::kInput); }

std::string bytes_text(const bus::Bytes& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) text += fmt::format("{}{:02X}", text.empty() ? "" : " ", byte);
  return text;
}

/// Reads characters from the edges of a line and keeps the telegram begun last.
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

void History::add(Tick at, Side side, Pin pin, Level level) {
  changes_.push_back({at, side, pin, level});
  forget_before(at - span_);
  if (pin != Pin::kPbrxd) return;
  line_.push_back({at, level != 0});
  if (line_.size() > kLineEdges) line_.pop_front();
}

void History::forget_before(Tick oldest) {
  for (; !changes_.empty() && changes_.front().at < oldest; changes_.pop_front()) {
    const Change& change = changes_.front();
    begin(change.side, change.pin, change.level);
  }
}

void History::write_wave(const std::string& path, Tick end) const {
  const std::unique_ptr<tb::WaveWriter> writer = tb::open_wave(path);
  std::array<std::array<tb::WaveWriter::Signal, dsdpv1::kPinCount>, kSides> signals{};
  for (std::size_t side = 0; side < kSides; ++side) {
    writer->open_scope(kScopes.at(side));
    for (std::size_t i = 0; i < dsdpv1::kPinCount; ++i) {
      const Pin pin = static_cast<Pin>(i);
      if (belongs(static_cast<Side>(side), pin))
        signals.at(side).at(i) = writer->wire(dsdpv1::name(pin), dsdpv1::width(pin));
    }
    writer->close_scope();
  }
  const Tick begin = std::max<Tick>(0, changes_.empty() ? 0 : std::min(changes_.front().at, end - span_));
  for (std::size_t side = 0; side < kSides; ++side) {
    for (std::size_t i = 0; i < dsdpv1::kPinCount; ++i)
      if (belongs(static_cast<Side>(side), static_cast<Pin>(i)))
        writer->set(begin, signals.at(side).at(i), levels_.at(side).at(i));
  }
  // Each side tells its changes in order of time, the sides in turns.
  std::vector<Change> ordered(changes_.begin(), changes_.end());
  std::stable_sort(ordered.begin(), ordered.end(), [](const Change& a, const Change& b) { return a.at < b.at; });
  for (const Change& change : ordered)
    writer->set(std::max(begin, change.at), signals.at(static_cast<std::size_t>(change.side)).at(index(change.pin)),
                change.level);
  writer->finish(std::max(end, begin));
}

LineTelegram History::last_telegram(int rate) const {
  if (line_.empty()) return {};
  LineReader reader(rate >= 0 && rate < static_cast<int>(bus::kBauds.size()) ? rate : likely_rate());
  for (const LineEdge& edge : line_) reader.edge(edge.at, edge.level);
  reader.run(line_.back().at + 11 * bus::baud(9).bit);
  return reader.telegram();
}

int History::likely_rate() const {
  Tick shortest = bus::baud(9).bit;
  for (std::size_t i = 1; i < line_.size(); ++i) shortest = std::min(shortest, line_[i].at - line_[i - 1].at);
  int rate = 9;
  while (rate > 0 && bus::baud(rate).bit > shortest + shortest / 4) --rate;
  return rate;
}

}  // namespace cosim

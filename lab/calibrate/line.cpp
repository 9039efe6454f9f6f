#include "lab/calibrate/line.hpp"

#include <array>
#include <cstdlib>
#include <limits>
#include <optional>

#include "bus/wire/uart.hpp"

namespace dsdpv1::calibrate {
namespace {

/// The places at which a bit may be sampled: with two samples a bit one of them may be just before or after an edge.
constexpr std::array<double, 5> kPlaces = {0.5, 0.4, 0.6, 0.3, 0.7};

class LineReader {
 public:
  /// `glitches`: low levels of less than half a bit are ignored.
  LineReader(const Trace& trace, const TimeBase& time, const std::vector<LineTelegram>& rates, bool glitches)
      : trace_(trace), time_(time), rates_(rates), glitches_(glitches) {}

  std::vector<LineTelegram> read() {
    std::vector<LineTelegram> found;
    for (std::size_t edge = trace_.next(0, false); edge < trace_.edges.size();) {
      if (glitches_ && is_glitch(edge)) {
        edge += 2;
        continue;
      }
      LineTelegram telegram = telegram_at(edge);
      if (telegram.right) {
        edge = trace_.next(telegram.last_start + stop_bit(telegram.baud), false);
      } else {
        edge = after_silence(telegram);
        telegram.last_edge = trace_.edges[edge - 1];
      }
      found.push_back(std::move(telegram));
    }
    return found;
  }

 private:
  static Tick stop_bit(int baud) { return static_cast<Tick>(10.5 * static_cast<double>(bus::baud(baud).bit)); }

  LineTelegram telegram_at(std::size_t edge) {
    const Tick at = trace_.edges[edge];
    take_rate_of_others(at);
    std::vector<int> order;
    if (baud_) order.push_back(*baud_);
    for (int baud = 0; baud < bus::kBaudCount; ++baud)
      if (baud != baud_) order.push_back(baud);
    for (const int baud : order) {
      LineTelegram telegram = try_at(edge, baud);
      const bool alone = telegram.right && telegram.telegram.kind == bus::TelegramKind::kSc && baud != baud_;
      if (!telegram.right || alone) continue;  // a short acknowledgement alone shows no rate
      baud_ = baud;
      return telegram;
    }
    LineTelegram none = try_at(edge, baud_.value_or(0));
    none.right = false;
    none.telegram = {};
    return none;
  }

  /// The receiver samples again in the middle of the start bit.
  bool is_glitch(std::size_t edge) const {
    if (edge + 1 >= trace_.edges.size()) return false;
    const double low = TimeBase::nominal(trace_.edges[edge + 1] - trace_.edges[edge]);
    return low + time_.doubt() + 1 < TimeBase::nominal(bus::baud(baud_.value_or(0)).bit) / 2;
  }

  void take_rate_of_others(Tick at) {
    while (other_ < rates_.size() && rates_[other_].start <= at) {
      if (rates_[other_].right) baud_ = rates_[other_].baud;
      ++other_;
    }
  }

  LineTelegram try_at(std::size_t edge, int baud) const {
    LineTelegram telegram;
    telegram.start = trace_.edges[edge];
    telegram.baud = baud;
    bus::TelegramDecoder decoder;
    std::vector<Lateness> before;
    for (; edge < trace_.edges.size();
         edge = trace_.next(telegram.last_start + stop_bit(baud) - time_.margin() / 2, false)) {
      const Tick start = trace_.edges[edge];
      if (!telegram.bytes.empty() && after_gap(telegram, start - time_.margin())) return telegram;
      telegram.gap = telegram.gap || (!telegram.bytes.empty() && after_gap(telegram, start));
      shift(before, telegram, start);
      telegram.last_start = start;
      const int byte = character(edge, baud, before);
      if (byte < 0) return telegram;
      telegram.bytes.push_back(static_cast<std::uint8_t>(byte));
      if (const auto decoded = decoder.feed(static_cast<std::uint8_t>(byte))) {
        telegram.right = decoded->error == bus::DecodeError::kNone;
        telegram.telegram = decoded->telegram;
        return telegram;
      }
    }
    return telegram;
  }

  /// More than 1 bit time after the character before it, as recorded.
  static bool after_gap(const LineTelegram& telegram, Tick start) {
    return start > telegram.last_start + (bus::kCharacterBits + 1) * bus::baud(telegram.baud).bit;
  }

  /// The delay of a character's edges, from the least to the greatest; ticks.
  struct Lateness {
    double least = 0, most = 0;

    double spread() const { return most - least; }
    void add(double late) { least = std::min(least, late), most = std::max(most, late); }
    void add(const Lateness& other) { add(other.least), add(other.most); }
  };

  /// The delays of the characters directly before the one at `start`, when it follows them without a pause. Only some
  /// of them, because the sender has another clock.
  void shift(std::vector<Lateness>& before, const LineTelegram& telegram, Tick start) const {
    constexpr std::size_t kMost = 6;
    const Tick by = start - telegram.last_start - bus::kCharacterBits * bus::baud(telegram.baud).bit;
    if (std::abs(by) > time_.margin()) before.clear();
    if (before.size() > kMost) before.erase(before.begin());
    for (Lateness& each : before) each.least -= static_cast<double>(by), each.most -= static_cast<double>(by);
  }

  /// The right character that fits the edges best, including those before it; -1 when none does. Adds its delays to
  /// `before`.
  int character(std::size_t edge, int baud, std::vector<Lateness>& before) const {
    const auto bit = static_cast<double>(bus::baud(baud).bit);
    const Tick start = trace_.edges[edge];
    double best = std::numeric_limits<double>::max();
    Lateness own;
    int found = -1;
    for (const double place : kPlaces) {
      unsigned bits = 0;
      for (int i = 0; i < bus::kCharacterBits; ++i)
        bits |= (trace_.at(start + static_cast<Tick>((i + place) * bit)) ? 1U : 0U) << static_cast<unsigned>(i);
      const auto byte = static_cast<std::uint8_t>(bits >> 1U);
      if (bits != bus::Character::of(byte).bits) continue;
      const std::optional<Lateness> late = lateness_of(edge, bits, bit);
      if (!late || late->spread() >= most_spread(bit)) continue;
      Lateness all = *late;
      for (const Lateness& each : before) all.add(each);
      if (all.spread() >= best) continue;
      best = all.spread();
      own = *late;
      found = byte;
    }
    before.push_back(own);
    return found;
  }

  /// The most by which the delays of a right character's edges differ: sampling, jitter and the sender's clock; ticks,
  /// with a margin.
  double most_spread(double bit) const {
    constexpr double kSendersClock = 0.002;
    return (time_.doubt() + 1) * static_cast<double>(bus::kTicksPerCycle) + kSendersClock * bus::kCharacterBits * bit;
  }
  /// The times of these bits of the character; absent if the capture ends in it.
  std::optional<Lateness> lateness_of(std::size_t edge, unsigned bits, double bit) const {
    Lateness late;
    const Tick start = trace_.edges[edge];
    for (unsigned i = 1; i < bus::kCharacterBits; ++i) {
      if ((bits >> i & 1U) == (bits >> (i - 1) & 1U)) continue;
      if (++edge >= trace_.edges.size()) return std::nullopt;
      late.add(static_cast<double>(trace_.edges[edge] - start) - i * bit);
    }
    return late;
  }

  /// Characters that form no telegram end when the line is idle for a character: at the next edge.
  std::size_t after_silence(const LineTelegram& wrong) const {
    const Tick idle = (bus::kCharacterBits + 1) * bus::baud(wrong.baud).bit;
    std::size_t edge = trace_.count_until(wrong.start);
    while (edge < trace_.edges.size() && (!trace_.level(edge) || trace_.edges[edge] - trace_.edges[edge - 1] < idle))
      ++edge;
    return edge;
  }

  const Trace& trace_;
  const TimeBase& time_;
  const std::vector<LineTelegram>& rates_;
  const bool glitches_;
  std::size_t other_ = 0;
  std::optional<int> baud_;
};

}  // namespace

std::vector<LineTelegram> telegrams_received(const Trace& trace, const TimeBase& time) {
  return LineReader(trace, time, {}, true).read();
}

std::vector<LineTelegram> telegrams_sent(const Trace& trace, const TimeBase& time,
                                         const std::vector<LineTelegram>& received) {
  return LineReader(trace, time, received, false).read();
}

}  // namespace dsdpv1::calibrate

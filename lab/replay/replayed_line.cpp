#include "lab/replay/replayed_line.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "bus/baud.hpp"
#include "bus/wire/uart.hpp"

namespace dsdpv1::tb::replay {
namespace {

/// A damaged telegram; the capture does not show which of its characters were wrong.
bus::WireFaults faults_of(const RecordedTelegram& telegram) {
  bus::WireFaults faults;
  if ((telegram.damage & bus::capture::damage::kCharacter) != 0) faults.wrong_parity_at = telegram.bytes.size() - 1;
  return faults;
}

class TelegramLine : public ReplayedLine, private bus::Listener {
 public:
  TelegramLine(bus::Segment& segment, const Recording& recording, const std::vector<PlacedTelegram>& placed)
      : recording_(recording), placed_(placed), sender_(segment, segment.attach("recording", this)) {
    set_baud(recording.baud);
  }

  Tick next() const override { return sender_.busy() ? sender_.next() : ReplayedLine::next(); }
  void run(Tick now) override {
    if (!sender_.busy() && !begin_next(now)) return;
    sender_.run(now);
  }

 private:
  bool has_next() const override { return next_ < placed_.size(); }
  Tick next_recorded() const override { return placed_[next_].start; }
  /// False: the line has stopped.
  bool begin_next(Tick now) {
    const RecordedTelegram& telegram = recording_.telegrams[placed_[next_].telegram];
    if (telegram.baud != baud_) {
      set_baud(telegram.baud);
      if (on_baud) on_baud(telegram.baud);
    }
    const bool waits = placed_[next_].found && !waited_ && may_go_on && !may_go_on(next_);
    waited_ = waits;
    if (waits) {
      stop();
      return false;
    }
    ++next_;
    sender_.send(now, bus::characters(telegram.bytes, faults_of(telegram)));
    return true;
  }
  void set_baud(int baud) {
    baud_ = baud;
    sender_.set_timing(bus::baud(baud).bit);
  }

  void line_changed(Tick, bool) override {}
  bool run_begins(const bus::CharacterRun&) override { return true; }
  void run_cut(Tick at, bool) override {
    sender_.run_cut(at);
    announce();
  }

  const Recording& recording_;
  const std::vector<PlacedTelegram>& placed_;
  bus::UartSender sender_;
  int baud_ = 0;
  bool waited_ = false;  ///< for the rate of the next telegram
  std::size_t next_ = 0;
};

/// The recorded levels without the slave's, and without an incomplete telegram at the end.
std::vector<LevelChange> levels_of_others(const Recording& recording) {
  const Tick half_bit = bus::baud(recording.baud).bit / 2;
  std::vector<LevelChange> others;
  const auto drive = [&others](Tick at, bool level) {
    if (level != (others.empty() || others.back().level)) others.push_back({at, level});
  };
  auto telegram = recording.telegrams.begin();
  for (const LevelChange& change : recording.levels) {
    if (change.at > recording.end()) break;
    // The last stop bit is high, so no level of the slave remains at the end.
    while (telegram != recording.telegrams.end() && (!telegram->of_slave || telegram->end - half_bit < change.at))
      ++telegram;
    const bool of_slave = telegram != recording.telegrams.end() && change.at >= telegram->start - half_bit;
    drive(change.at, of_slave || change.level);
  }
  return others;
}

/// Drives low and releases for high, so it conflicts with the model's driver only if the two really disagree.
class LevelLine : public ReplayedLine {
 public:
  LevelLine(bus::Segment& segment, const Recording& recording)
      : segment_(segment), station_(segment.attach("recording", nullptr)), changes_(levels_of_others(recording)) {}

  void run(Tick now) override {
    const bool level = changes_[next_++].level;
    segment_.drive(station_, now, !level, level);
  }

 private:
  bool has_next() const override { return next_ < changes_.size(); }
  Tick next_recorded() const override { return changes_[next_].at; }

  bus::Segment& segment_;
  bus::StationId station_;
  std::vector<LevelChange> changes_;
  std::size_t next_ = 0;
};

void mark_found(std::vector<PlacedTelegram>& placed, const Recording& recording) {
  auto at = placed.begin();
  for (const RecordedRequest& each : recording.requests) {
    if (!each.found) continue;
    at = std::find_if(at, placed.end(), [&](const PlacedTelegram& one) { return one.telegram == each.telegram; });
    if (at == placed.end()) return;
    at->found = true;
  }
}

}  // namespace

std::vector<PlacedTelegram> place(const Recording& recording) {
  std::vector<PlacedTelegram> placed;
  const bool levels = !recording.levels.empty();
  Tick free = recording.telegrams.front().start;
  for (std::size_t i = 0; i < recording.telegrams.size(); ++i) {
    const RecordedTelegram& telegram = recording.telegrams[i];
    if (telegram.of_slave) continue;
    const Tick start = levels ? telegram.start : std::max(telegram.start, free);
    placed.push_back({i, start, start + telegram.end - telegram.start});
    free = placed.back().end;
  }
  if (!levels) mark_found(placed, recording);
  return placed;
}

std::unique_ptr<ReplayedLine> make_line(bus::Segment& segment, const Recording& recording,
                                        const std::vector<PlacedTelegram>& placed) {
  if (!recording.levels.empty()) return std::make_unique<LevelLine>(segment, recording);
  return std::make_unique<TelegramLine>(segment, recording, placed);
}

}  // namespace dsdpv1::tb::replay

#include "bus/capture/logic_decoder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "bus/baud.hpp"
#include "bus/capture/collector.hpp"
#include "bus/capture/lower_case.hpp"
#include "bus/monitor/monitor.hpp"
#include "bus/telegram/telegram.hpp"
#include "bus/wire/segment.hpp"

namespace dsdpv1::bus::capture {
namespace {

/// The name without its scope.
std::string leaf(const std::string& name) { return lower_case(name.substr(name.rfind('.') + 1)); }

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) text += (i == 0 ? "" : ", ") + names[i];
  return names.size() > kMost ? text + ", ..." : text;
}

std::optional<std::size_t> find(const std::vector<std::string>& names,
                                const std::function<bool(const std::string&)>& is) {
  const auto found = std::find_if(names.begin(), names.end(), is);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

std::optional<std::size_t> likely_line(const std::vector<std::string>& names) {
  for (const char* whole : {"line", "pbrxd", "pbtxd"})
    if (const auto found = find(names, [&](const std::string& name) { return leaf(name) == whole; })) return found;
  for (const char* part : {"rxd", "txd"})
    if (const auto found =
            find(names, [&](const std::string& name) { return leaf(name).find(part) != std::string::npos; }))
      return found;
  return std::nullopt;
}

}  // namespace

std::size_t choose_signal(const std::vector<std::string>& names, const std::string& wanted) {
  if (names.empty()) throw CaptureError("no signal of one bit, expected a recording of the line");
  if (!wanted.empty()) {
    if (const auto whole = find(names, [&](const std::string& name) { return name == wanted; })) return *whole;
    const std::string last = lower_case(wanted);
    if (const auto found = find(names, [&](const std::string& name) { return leaf(name) == last; })) return *found;
    throw CaptureError(fmt::format("no signal {}, expected {}", wanted, listed(names)));
  }
  if (names.size() == 1) return 0;
  if (const auto found = likely_line(names)) return *found;
  throw CaptureError("several signals, name that of the line with --signal, expected " + listed(names));
}

/// A segment at one rate, with only the monitor on it.
class LogicDecoder::Line {
 public:
  Line(int baud, bool inverted, TakeTelegram take)
      : inverted_(inverted),
        monitor_(segment_),
        collector_(std::move(take)),
        recording_(segment_.attach("recording", nullptr)) {
    monitor_.set_baud(baud);
    monitor_.on_telegram = [this](const WireTelegram& telegram) { collector_.telegram(telegram); };
    monitor_.on_flag = [this](const Flag& flag) { collector_.flagged(flag); };
    monitor_.on_skipped = [this, baud](const ReceivedCharacter& character) { collector_.skipped(character, baud); };
  }

  void change(const Change& change) {
    while (monitor_.next() < change.at) monitor_.run(monitor_.next());
    segment_.drive(recording_, change.at, true, change.level != inverted_);
  }
  void finish(Tick end) {
    while (monitor_.next() <= end) monitor_.run(monitor_.next());
    collector_.finish();
  }

 private:
  bool inverted_;
  Segment segment_;
  Monitor monitor_;
  Collector collector_;
  StationId recording_;
};

LogicDecoder::LogicDecoder(const LogicSettings& settings, TakeTelegram take)
    : baud_(settings.baud), inverted_(settings.inverted), take_(std::move(take)), on_change_(settings.on_change) {
  if (baud_) line_ = std::make_unique<Line>(*baud_, inverted_, take_);
}

LogicDecoder::~LogicDecoder() = default;

void LogicDecoder::level(Tick at, bool level) {
  if (level_ == level) return;
  level_ = level;
  if (on_change_) on_change_(at, level != inverted_);
  change({at, level});
}

void LogicDecoder::change(const Change& change) {
  if (line_) return line_->change(change);
  waiting_.push_back(change);
  if (waiting_.size() >= kTrialChanges) decide(change.at);
}

void LogicDecoder::finish(Tick end) {
  if (!line_) decide(end);
  // A telegram that ends with the recording is decoded in the middle of its last stop bit.
  line_->finish(end + bus::baud(*baud_).bit * kCharacterBits);
}

void LogicDecoder::decide(Tick end) {
  baud_ = best_rate(end);
  line_ = std::make_unique<Line>(*baud_, inverted_, take_);
  for (const Change& each : waiting_) line_->change(each);
  waiting_ = {};
}

/// The number of bytes in valid telegrams at the beginning; those with an FCS count more than a token or SC, which
/// occur in any noise.
std::uint64_t LogicDecoder::worth(int baud, Tick end, bool inverted) const {
  constexpr std::uint64_t kWithFcs = 100;
  std::uint64_t sum = 0;
  Line line(baud, inverted, [&sum](const CapturedTelegram& telegram) {
    if ((telegram.damage & ~damage::kGap) != 0) return;
    const bool fcs = telegram.bytes[0] != sd::k4 && telegram.bytes[0] != sd::kSc;
    sum += telegram.bytes.size() * (fcs ? kWithFcs : 1);
  });
  for (const Change& each : waiting_) line.change(each);
  line.finish(end + bus::baud(baud).bit * kCharacterBits);
  return sum;
}

int LogicDecoder::best_rate(Tick end) const {
  std::array<std::uint64_t, kBaudCount> right = {}, inverted = {};
  for (int baud = 0; baud < kBaudCount; ++baud) right.at(static_cast<std::size_t>(baud)) = worth(baud, end, inverted_);
  const auto best = std::max_element(right.begin(), right.end());
  if (*best > 0) return static_cast<int>(best - right.begin());
  for (int baud = 0; baud < kBaudCount; ++baud)
    inverted.at(static_cast<std::size_t>(baud)) = worth(baud, end, !inverted_);
  const bool other = *std::max_element(inverted.begin(), inverted.end()) > 0;
  throw CaptureError(fmt::format("no right telegram at any of the ten baud rates{}, expected a recording of the line",
                                 !other      ? ""
                                 : inverted_ ? " (without --invert there are some)"
                                             : " (with --invert there are some)"));
}

}  // namespace dsdpv1::bus::capture

#include "tb/serve/host_link.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <utility>

namespace dsdpv1::tb::serve {
namespace {

constexpr Tick kSlice = bus::kTicksPerMs;
constexpr Tick kBusySlice = kSlice / 10;
constexpr std::chrono::seconds kBetweenComplaints{5};

}  // namespace

HostLink::HostLink(std::unique_ptr<HostConnection> port, bus::Segment& segment, int baud)
    : port_(std::move(port)), line_(segment, baud) {
  port_->say = [this](const std::string& text) { tell_about_port(text); };
  port_->on_gone = [this] {
    intake_.clear();
    line_.forget();
    on_gone();
  };
}

void HostLink::begin(Tick now) {
  now_ = now;
  pace_.emplace(WallClock::now, now);
}

std::size_t HostLink::room(Tick now) const {
  const bool caught_up = pace_->target() <= now + 2 * kSlice;
  if (!intake_.holding() && pace_->now() < rest_until_ && !caught_up) return 0;
  const std::size_t waiting = intake_.size() + line_.waiting_bytes();
  return std::max(kMostWaiting - std::min(waiting, kMostWaiting), intake_.missing());
}

/// A request tells the host's mistake if it came in any case less than the slot time after the one before, and the two
/// naps that serve may take before it sends, and before it reads an answer.
void HostLink::pass_on(Tick now, Tick at, Taken telegram) {
  const bool soon = to_ticks(pace_->now() - asked_after_) < line_.slot() + 2 * kSlice;
  if (!port_->timed() && soon && line_.owes_answer(now) && !HostLine::is_answer(telegram.bytes))
    on_early(at, telegram.bytes);
  if (line_.send(at, std::move(telegram.bytes), telegram.wrong_at)) asked_after_ = came_after_;
}

void HostLink::take(Tick now) {
  now_ = now;
  const std::size_t most = room(now);
  const WallTime looked = pace_->now();
  const bus::Bytes bytes = port_->receive(most);
  if (!bytes.empty()) came_after_ = all_read_;
  if (bytes.size() < most) all_read_ = looked;
  intake_.take(bytes, pace_->now(), port_->wrong());
  // A late read of the clock must not delay a telegram that came meanwhile.
  const Tick at = std::clamp(pace_->target(), now, now + kSlice);
  while (auto telegram = intake_.next(pace_->now())) pass_on(now, held_since_ ? now : at, std::move(*telegram));
  hold_time();
}

void HostLink::hold_time() {
  const WallTime now = pace_->now();
  if (intake_.holding()) {
    if (!held_since_) held_since_ = now;
  } else if (held_since_) {
    const auto held = now - *held_since_;
    pace_->hold(to_ticks(held));
    if (held > Intake::kPatience) rest_until_ = now + held;
    held_since_.reset();
  }
}

Tick HostLink::limit(Tick now) const {
  if (intake_.holding()) return now;
  const bool ahead = port_->timed() && line_.busy(now);
  return ahead ? now + kSlice : std::min(pace_->target(), now + kSlice);
}

void HostLink::give(Tick now) {
  now_ = now;
  if (!intake_.holding())
    if (const auto loss = pace_->check(now)) tell(*loss);
  port_->send(line_.take_heard(now, port_->timed()));
  tell_left_out(false);
}

void HostLink::sleep(Tick now) {
  WallTime until = pace_->wall(now + (line_.busy(now) ? kBusySlice : kSlice));
  if (intake_.holding()) until = intake_.give_up_at();
  if (!intake_.holding() && port_->timed() && line_.busy(now)) return;
  const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(until - pace_->now());
  if (left.count() <= 0) return;
  pollfd watched = port_->watched(room(now) > 0);
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
  const timespec timeout{static_cast<time_t>(seconds.count()), static_cast<long>((left - seconds).count())};
  ::ppoll(&watched, 1, &timeout, nullptr);
}

void HostLink::end(Tick now) {
  now_ = now;
  tell_left_out(true);
}

void HostLink::tell_about_port(const std::string& text) {
  tell_left_out(false);
  if (lines_.allows(WallClock::now())) say(now_, text);
}

void HostLink::tell_left_out(bool at_end) {
  if (const std::uint64_t count = lines_.left_out(WallClock::now(), !at_end))
    say(now_, fmt::format("{}: {} more such lines are left out", port_->name(), count));
}

void HostLink::tell(const Pace::Loss& loss) {
  const WallTime now = pace_->now();
  if (std::exchange(told_, true) && now - told_at_ < kBetweenComplaints) return;
  told_at_ = now;
  const double lag_ms = static_cast<double>(loss.lag) / static_cast<double>(bus::kTicksPerMs);
  late(now_,
       fmt::format("this computer is too slow: {:.0f} ms behind real time, it simulates at {:.2f} of real time; going "
                   "on, {:.1f} s given up so far",
                   lag_ms, loss.speed,
                   static_cast<double>(pace_->statistics().lost) / static_cast<double>(bus::kTicksPerSecond)));
}

Pacing HostLink::pacing() const {
  return {port_->name(), line_.statistics(), pace_ ? pace_->statistics() : PaceStatistics()};
}

}  // namespace dsdpv1::tb::serve

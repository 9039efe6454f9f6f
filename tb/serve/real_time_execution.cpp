#include "tb/serve/real_time_execution.hpp"

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

RealTimeExecution::RealTimeExecution(std::unique_ptr<HostConnection> port, int baud)
    : port_(std::move(port)), line_(segment_, baud) {
  port_->say = [this](const std::string& text) { tell_about_port(text); };
  port_->on_gone = [this] {
    intake_.clear();
    line_.forget();
  };
}

void RealTimeExecution::join() { timeline_.add(line_); }

void RealTimeExecution::run(Tick end, const std::function<bool()>& stopped) {
  pace_.emplace(WallClock::now, timeline_.now());
  while (!stopped() && timeline_.now() < end) {
    take_from_host();
    advance(end);
    give_to_host();
    tell_left_out(false);
    sleep();
  }
  tell_left_out(true);
}

std::size_t RealTimeExecution::room() const {
  const bool caught_up = pace_->target() <= timeline_.now() + 2 * kSlice;
  if (!intake_.holding() && pace_->now() < rest_until_ && !caught_up) return 0;
  const std::size_t waiting = intake_.size() + line_.waiting_bytes();
  return std::max(kMostWaiting - std::min(waiting, kMostWaiting), intake_.missing());
}

void RealTimeExecution::take_from_host() {
  intake_.take(port_->receive(room()), pace_->now());
  // A late read of the clock must not delay a telegram that came meanwhile.
  const Tick at = std::clamp(pace_->target(), timeline_.now(), timeline_.now() + kSlice);
  while (auto telegram = intake_.next(pace_->now()))
    line_.send(held_since_ ? timeline_.now() : at, std::move(*telegram));
  hold_time();
}

void RealTimeExecution::hold_time() {
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

/// The limit of simulated time at present.
Tick RealTimeExecution::limit() const {
  const Tick now = timeline_.now();
  if (intake_.holding()) return now;
  const bool ahead = port_->timed() && line_.busy(now);
  return ahead ? now + kSlice : std::min(pace_->target(), now + kSlice);
}

void RealTimeExecution::advance(Tick end) {
  const Tick to = std::min(limit(), end);
  if (to > timeline_.now()) timeline_.run_until(to);
  if (intake_.holding()) return;
  if (const auto loss = pace_->check(timeline_.now())) tell(*loss);
}

void RealTimeExecution::give_to_host() {
  const bus::Bytes heard = line_.take_heard(timeline_.now(), port_->timed());
  port_->send(heard);
}

void RealTimeExecution::sleep() {
  const Tick now = timeline_.now();
  WallTime until = pace_->wall(now + (line_.busy(now) ? kBusySlice : kSlice));
  if (intake_.holding()) until = intake_.give_up_at();
  if (!intake_.holding() && port_->timed() && line_.busy(now)) return;
  const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(until - pace_->now());
  if (left.count() <= 0) return;
  pollfd watched = port_->watched(room() > 0);
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
  const timespec timeout{static_cast<time_t>(seconds.count()), static_cast<long>((left - seconds).count())};
  ::ppoll(&watched, 1, &timeout, nullptr);
}

void RealTimeExecution::tell_about_port(const std::string& text) {
  tell_left_out(false);
  if (lines_.allows(WallClock::now())) say(timeline_.now(), text);
}

void RealTimeExecution::tell_left_out(bool at_end) {
  if (const std::uint64_t count = lines_.left_out(WallClock::now(), !at_end))
    say(timeline_.now(), fmt::format("{}: {} more such lines are left out", port_->name(), count));
}

void RealTimeExecution::tell(const Pace::Loss& loss) {
  const WallTime now = pace_->now();
  if (std::exchange(told_, true) && now - told_at_ < kBetweenComplaints) return;
  told_at_ = now;
  const double lag_ms = static_cast<double>(loss.lag) / static_cast<double>(bus::kTicksPerMs);
  say(timeline_.now(),
      fmt::format("this computer is too slow: {:.0f} ms behind real time, it simulates at {:.2f} of real time; going "
                  "on, {:.1f} s given up so far",
                  lag_ms, loss.speed,
                  static_cast<double>(pace_->statistics().lost) / static_cast<double>(bus::kTicksPerSecond)));
}

Pacing RealTimeExecution::pacing() const {
  return {port_->name(), line_.statistics(), pace_ ? pace_->statistics() : PaceStatistics()};
}

}  // namespace dsdpv1::tb::serve

#include "tb/report/progress.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace dsdpv1::tb {
namespace {

constexpr int kWidth = 30;

std::string bar_of(double done) { return std::string(static_cast<std::size_t>(done * kWidth), '#'); }

}  // namespace

std::string progress_text(bus::Tick now, bus::Tick end, double wall_s) {
  const double done = static_cast<double>(now) / static_cast<double>(end);
  const double simulated_s = static_cast<double>(now) / static_cast<double>(bus::kTicksPerSecond);
  const double factor = wall_s > 0 ? simulated_s / wall_s : 0;
  const double left = done > 0 ? wall_s / done - wall_s : 0;
  return fmt::format("[{:<{}}] {:3.0f} %  {:.1f} of {:.1f} ms  {:.2f} x real time  {:.0f} s left", bar_of(done), kWidth,
                     done * 100, simulated_s * 1e3, static_cast<double>(end) / static_cast<double>(bus::kTicksPerMs),
                     factor, left);
}

void Progress::show(bus::Tick now) {
  using namespace std::chrono_literals;
  const Clock::time_point time = Clock::now();
  if (!wanted_ || time - last_ < 100ms) return;
  last_ = time;
  drawn_ = true;
  fmt::print(stderr, "\r{}\033[K", progress_text(now, end_, std::chrono::duration<double>(time - begin_).count()));
  std::fflush(stderr);
}

void Progress::clear() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
  drawn_ = false;
}

std::string share_text(double done, double wall_s) {
  const double left = done > 0 ? wall_s / done - wall_s : 0;
  return fmt::format("[{:<{}}] {:3.0f} %  {:.0f} s left", bar_of(done), kWidth, done * 100, left);
}

void ShareProgress::show(double done) {
  using namespace std::chrono_literals;
  const Clock::time_point time = Clock::now();
  if (!wanted_ || time - last_ < 100ms) return;
  last_ = time;
  fmt::print(stderr, "\r{}\033[K", share_text(done, std::chrono::duration<double>(time - begin_).count()));
  std::fflush(stderr);
}

void ShareProgress::clear() const {
  if (wanted_) fmt::print(stderr, "\r\033[K");
}

std::string count_text(const Count& count, const std::string& what, double wall_s) {
  const auto number = [](std::size_t of) { return static_cast<double>(of); };
  const double part = count.all == 0 ? 1 : number(count.done) / number(count.all);
  std::string bar =
      fmt::format("[{:<{}}] {} of {} {}  {:.0f} s", bar_of(part), kWidth, count.done, count.all, what, wall_s);
  if (count.done == count.before) return bar;
  const double each = wall_s / number(count.done - count.before);
  return bar + fmt::format(", {:.0f} s left", each * number(count.all - count.done));
}

void CountProgress::show(std::size_t done) {
  using namespace std::chrono_literals;
  const Clock::time_point time = Clock::now();
  if (!wanted_ || (done == shown_ && time - last_ < 1s)) return;
  shown_ = done;
  last_ = time;
  const double wall_s = std::chrono::duration<double>(time - begin_).count();
  fmt::print(stderr, "\r{}\033[K", count_text({done, all_, before_}, what_, wall_s));
  std::fflush(stderr);
}

void CountProgress::clear() const {
  if (wanted_) fmt::print(stderr, "\r\033[K");
}

}  // namespace dsdpv1::tb

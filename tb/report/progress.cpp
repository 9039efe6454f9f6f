#include "tb/report/progress.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace tb {

std::string progress_text(bus::Tick now, bus::Tick end, double wall_s) {
  constexpr int kWidth = 30;
  const double done = static_cast<double>(now) / static_cast<double>(end);
  const double simulated_s = static_cast<double>(now) / static_cast<double>(bus::kTicksPerSecond);
  const double factor = wall_s > 0 ? simulated_s / wall_s : 0;
  const double left = done > 0 ? wall_s / done - wall_s : 0;
  const std::string bar(static_cast<std::size_t>(done * kWidth), '#');
  return fmt::format("[{:<{}}] {:3.0f} %  {:.1f} of {:.1f} ms  {:.2f} x real time  {:.0f} s left", bar, kWidth,
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

}  // namespace tb

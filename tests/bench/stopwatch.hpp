#pragma once
// CPU time of this process, which other work on the machine affects less than wall time.
#include <ctime>

namespace dsdpv1::speed {

inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) / 1e9;
}

class Stopwatch {
 public:
  double seconds() const { return cpu_seconds() - begin_; }

 private:
  double begin_ = cpu_seconds();
};

}  // namespace dsdpv1::speed

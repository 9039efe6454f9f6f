#pragma once
// Figures of a simulation in real time with an external host, as plain values.
#include <cstdint>
#include <string>

#include "bus/time.hpp"

namespace dsdpv1::tb {

using bus::Tick;

/// Bytes and telegrams of an external host (serve).
struct HostLineStatistics {
  std::uint64_t telegrams = 0;    ///< received from the host
  std::uint64_t sent_bytes = 0;   ///< by the host
  std::uint64_t heard_bytes = 0;  ///< by the host
  std::uint64_t held_back = 0;    ///< telegrams delayed because they came before T_SYN or the slot time had ended
  Tick longest_held_back = 0;
};

/// How well simulated time followed real time (serve).
struct PaceStatistics {
  std::uint64_t samples = 0;
  double error_sum_us = 0, error_max_us = 0;  ///< delay of execution after the simulated time
  std::uint64_t losses = 0;                   ///< how often the computer was too slow and time was given up
  Tick lost = 0;                              ///< simulated time given up in total

  double error_mean_us() const { return samples == 0 ? 0 : error_sum_us / static_cast<double>(samples); }
};

/// A run with an external host (serve).
struct Pacing {
  std::string port;
  HostLineStatistics line;
  PaceStatistics pace;
};

}  // namespace dsdpv1::tb

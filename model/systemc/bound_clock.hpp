#pragma once
// A bound CLK: counts its edges into the chip's ticks and measures its frequency.
#include <cstdint>
#include <optional>
#include <systemc>

#include "model/systemc/sim_time.hpp"

namespace dsdpv1::systemc {

using profibus::Tick;

/// The n-th rising edge (from 0) is the core's cycle n. Between two edges the chip's time follows simulation time, but
/// never reaches an edge before CLK does: a slow, fast or asymmetric CLK stretches or shortens the pause before it.
class BoundClock {
 public:
  /// Rising edges over which the frequency is measured: 10 us at 48 MHz.
  static constexpr std::int64_t kWindow = 480;

  explicit BoundClock(double tolerance_ppm) : tolerance_ppm_(tolerance_ppm) {}

  void rising(const sc_core::sc_time& now);
  void falling(const sc_core::sc_time& now);
  /// The chip's tick at `now`, which is not before the last edge.
  Tick chip_tick(const sc_core::sc_time& now) const;
  std::int64_t edges() const { return cycle_ + 1; }

  /// The frequency in MHz, if the window closed by the last rising edge is the first one outside the tolerance.
  std::optional<double> take_wrong_frequency();

  /// At `now`, of the save or of the restore.
  template <class Archive>
  void store(Archive& archive, const sc_core::sc_time& now) {
    archive(cycle_, high_, reported_, measures_);
    store_age(archive, now, edge_);
    measures_ = store_age(archive, now, window_start_) && measures_;
  }

 private:
  void close_window(const sc_core::sc_time& now);
  /// False: it was before time 0 of this simulation.
  template <class Archive>
  static bool store_age(Archive& archive, const sc_core::sc_time& now, sc_core::sc_time& time) {
    sc_core::sc_time age = now - time;
    store_duration(archive, age);
    time = age > now ? sc_core::SC_ZERO_TIME : now - age;
    return age <= now;
  }

  double tolerance_ppm_;
  std::int64_t cycle_ = -1;
  bool high_ = false;
  sc_core::sc_time edge_{sc_core::SC_ZERO_TIME}, window_start_{sc_core::SC_ZERO_TIME};
  std::optional<double> wrong_mhz_;
  bool reported_ = false;
  bool measures_ = true;  ///< window_start_ is known
};

}  // namespace dsdpv1::systemc

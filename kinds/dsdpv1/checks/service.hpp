#pragma once
// Checks that the user is quick enough: INTR0 (P7, 4.1.6), and holds compared with the bus cycle (H1, H5).
#include <optional>

#include "bus/monitor/monitor.hpp"
#include "kinds/dsdpv1/checks/check.hpp"
#include "kinds/dsdpv1/checks/port_timing.hpp"
#include "tb/chip/checks/own_station.hpp"
#include "tb/chip/checks/recorder.hpp"

namespace dsdpv1::checks {

class Service {
 public:
  /// `station` must outlive it. `interval`: the check that compares holds with the bus cycle.
  Service(Recorder& recorder, const OwnStation& station, Check interval = Check::kHoldInterval)
      : recorder_(recorder), station_(station), interval_(interval) {}

  /// RESET is low.
  void reset();
  void intr0(Tick at, bool level);
  void accessed(const Access& access);
  /// The user held the chip off from `since` to `at`.
  void held_off(Tick since, Tick at);
  /// A telegram on the line, at `now`; `held_off_since`: the user has held the chip off since then.
  void telegram(Tick now, const bus::WireTelegram& telegram, std::optional<Tick> held_off_since);
  /// End of the run: judges an unserved INTR0 as if it were served now.
  void finish(Tick at, std::optional<Tick> held_off_since);

 private:
  void pass(Tick at, std::optional<Tick> held_off_since);
  void add_part(Tick since, Tick at);
  void exchange(Tick at);

  Recorder& recorder_;
  const OwnStation& station_;
  Check interval_;
  std::optional<Tick> intr0_fell_;  ///< and has not been served
  // A Data_Exchange counts from its execution, a bit time after its end (docs/microarchitecture.md, section 7):
  // intervals run between these.
  std::optional<Tick> due_exchange_;   ///< has been received
  std::optional<Tick> last_exchange_;  ///< was executed
  Tick longest_part_ = 0;   ///< longest part of the interval since then during which the user held the chip off
  Tick longest_since_ = 0;  ///< its begin
};

}  // namespace dsdpv1::checks

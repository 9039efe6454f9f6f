#pragma once
// Whether the user is quick enough: INTR0 (P7, 4.1.6), and holds against the bus cycle (H1, H5).
#include <optional>

#include "bus/monitor.hpp"
#include "tb/checks/port_timing.hpp"
#include "tb/checks/recorder.hpp"

namespace checks {

class Service {
 public:
  explicit Service(Recorder& recorder) : recorder_(recorder) {}

  /// RESET is low. The station's address has to be learnt again.
  void reset();
  void intr0(Tick at, bool level);
  void pbrts(Tick at, bool level);
  void accessed(const Access& access);
  /// R_REQ fell; it had been high since `since`.
  void request_ended(Tick since, Tick at);
  /// A telegram of the line has ended; `requested_since`: R_REQ is high since then.
  void telegram(const bus::WireTelegram& telegram, std::optional<Tick> requested_since);
  /// The run ends: an INTR0 not served is judged as if it were now.
  void finish(Tick at);

 private:
  bool is_own_answer(const bus::WireTelegram& telegram) const;
  bool is_exchange(const bus::WireTelegram& telegram) const;
  void exchange(Tick at, std::optional<Tick> requested_since);

  Recorder& recorder_;
  std::optional<Tick> intr0_fell_;  ///< and nobody has served it
  std::optional<std::uint8_t> address_;
  bool sending_ = false;
  Tick pbrts_rose_ = 0, pbrts_fell_ = 0;
  std::optional<Tick> last_exchange_;
  Tick longest_hold_ = 0;  ///< that ended after it
};

}  // namespace checks

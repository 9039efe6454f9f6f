#pragma once
// Reports a run to the caller, or keeps what the caller asked for.
#include <deque>
#include <string>
#include <vector>

#include "bus/wire/segment.hpp"
#include "capi/changes.hpp"
#include "capi/chip.hpp"
#include "dsdpv1/run.h"
#include "tb/bench/observer.hpp"

namespace dsdpv1::capi {

class RunWatch : public tb::Observer, private bus::Listener {
 public:
  /// For a run of `scenario`, which must outlive it.
  explicit RunWatch(const tb::scenario::Scenario& scenario);

  // --- Before the run.
  void on_change(dpsim_change_fn fn, void* user);
  void on_telegram(dpsim_telegram_fn fn, void* user);
  void on_event(dpsim_chip_event_fn fn, void* user);
  /// A set of DPSIM_KEEP_...
  void keep(std::uint32_t what) { kept_ = what; }
  bool wants_pins() const { return change_fn_ != nullptr || (kept_ & DPSIM_KEEP_CHANGES) != 0; }
  /// Attaches to the line as a separate station.
  void listen(bus::Segment& segment);

  // --- After it.
  Changes& changes() { return changes_; }
  const std::vector<dpsim_heard>& telegrams() const { return telegrams_; }
  /// Throws if a change could not be kept.
  void check() { changes_.check(); }

  /// The slave's number.
  std::uint16_t slave_of(const std::string& name) const;

  void begins(std::size_t slave, const tb::ChipView& chip) override;
  void pin(std::size_t slave, Tick at, tb::PinNumber pin, tb::Level level) override;
  void event(std::size_t slave, const profibus::Event& event) override { events_[slave].add(event); }
  void telegram(const tb::HeardTelegram& heard) override;

 private:
  void line_changed(Tick at, bool level) override { tell(at, DPSIM_LINE, 0, level ? 1 : 0); }
  void tell(Tick at, std::uint16_t station, tb::PinNumber pin, tb::Level level);

  const tb::scenario::Scenario& scenario_;
  bus::Segment* segment_ = nullptr;
  std::uint32_t kept_ = 0;
  Clock clock_;
  Changes changes_{clock_};
  dpsim_change_fn change_fn_ = nullptr;
  void* change_user_ = nullptr;
  dpsim_telegram_fn telegram_fn_ = nullptr;
  void* telegram_user_ = nullptr;
  std::vector<ChipEvents> events_;  ///< by slave
  std::vector<dpsim_heard> telegrams_;
  std::deque<bus::Bytes> bytes_;  ///< of telegrams_
};

}  // namespace dsdpv1::capi

#pragma once
// Reports the line and its drivers to the caller.
#include <functional>
#include <optional>

#include "bus/bytes.hpp"
#include "bus/wire/segment.hpp"
#include "capi/changes.hpp"

namespace dsdpv1::capi {

class LineTap : public bus::Listener {
 public:
  /// Attaches as a separate station. Both must outlive it. Calls `on_activity` for each change and each telegram on the
  /// line before any station attached later.
  LineTap(bus::Segment& segment, Changes& changes, std::function<void()> on_activity);

  /// A set of DPSIM_WATCH_...; `now` is the bus's present tick.
  void watch(bus::Tick now, std::uint32_t what);
  /// The level of the line at `now`.
  bool level(bus::Tick now) const;
  /// A driver on the segment, see `bus::Segment::on_drive`.
  void driven(std::uint16_t station, bus::Tick at, bool enabled, bool level);

  void line_changed(bus::Tick at, bool level) override;
  bool run_begins(const bus::CharacterRun& run) override;
  void run_cut(bus::Tick at, bool level) override;

 private:
  struct Driver {
    bool enabled = false, level = true;
  };
  void tell(bus::Tick at, std::uint16_t station, std::uint16_t pin, bool level);
  Driver& driver_of(std::uint16_t station);

  bus::Segment& segment_;
  Changes& changes_;
  std::function<void()> on_activity_;
  std::uint32_t watched_ = 0;
  std::vector<Driver> drivers_;           ///< by station
  std::optional<bus::CharacterRun> run_;  ///< on the line, without driven levels
  bus::Bytes bytes_;                      ///< of `run_`
};

}  // namespace dsdpv1::capi

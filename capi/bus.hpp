#pragma once
// A segment with its stations, as the object of the header's handle.
#include <cstdint>
#include <memory>
#include <vector>

#include "bus/monitor/monitor.hpp"
#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "capi/changes.hpp"
#include "capi/line_tap.hpp"
#include "capi/names.hpp"
#include "dsdpv1/bus.h"

struct dpsim_chip;
struct dpsim_master;

namespace dsdpv1::tb {
class ScenarioMasters;
}

namespace dsdpv1::capi {

struct Station {
  enum class Kind : std::uint8_t { kChip, kMaster, kOutside };
  bus::StationId id = 0;  ///< on the segment
  Kind kind = Kind::kChip;
};

/// Converts a telegram to the header's struct.
dpsim_heard heard_of(const bus::WireTelegram& telegram);

/// An event with default members.
dpsim_event event_of(dpsim_event_type type, bus::Tick at);

}  // namespace dsdpv1::capi

struct dpsim_bus {
  explicit dpsim_bus(int baud_index);
  ~dpsim_bus();
  dpsim_bus(const dpsim_bus&) = delete;
  dpsim_bus& operator=(const dpsim_bus&) = delete;

  /// Runs up to and including `tick`, which is not before now.
  void run(bus::Tick tick);
  std::uint16_t next_station() const { return static_cast<std::uint16_t>(stations.size()); }
  void add_station(const capi::Station& station) { stations.push_back(station); }
  /// Stations are ordered: chips, monitor, all others.
  void end_chips();
  /// After a call that reported changes: throws if one could not be kept.
  void check_changes();
  void tell(const dpsim_event& event) {
    if (event_fn == nullptr) return;
    const capi::Callback inside(clock);
    event_fn(event_user, &event);
  }

  const int baud;
  capi::Clock clock;
  bus::Segment segment;
  bus::Timeline timeline;
  std::vector<capi::Station> stations;
  std::vector<std::unique_ptr<dpsim_chip>> chips;
  capi::Changes changes{clock};
  std::unique_ptr<capi::LineTap> tap;     ///< null while chips may be added
  std::unique_ptr<bus::Monitor> monitor;  ///< null while chips may be added
  std::vector<std::unique_ptr<tb::ScenarioMasters>> scenarios;
  std::vector<std::unique_ptr<dpsim_master>> masters;

  dpsim_telegram_fn telegram_fn = nullptr;
  void* telegram_user = nullptr;
  dpsim_event_fn event_fn = nullptr;
  void* event_user = nullptr;

 private:
  void drive(bus::StationId id, bus::Tick at, bool enabled, bool level);
};

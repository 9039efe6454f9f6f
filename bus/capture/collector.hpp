#pragma once
// Makes captured telegrams from the monitor's reports.
#include <string>
#include <utility>
#include <vector>

#include "bus/capture/captured_telegram.hpp"
#include "bus/monitor/monitor.hpp"

namespace dsdpv1::bus::capture {

/// Keeps a telegram until the next one begins: flags raised meanwhile, and characters after a wrong byte, belong to it.
class Collector {
 public:
  explicit Collector(TakeTelegram take) : take_(std::move(take)) {}

  void telegram(const WireTelegram& telegram);
  void flagged(const Flag& flag);
  void skipped(const ReceivedCharacter& character, int baud);
  /// Passes on the last telegram.
  void finish();
  /// Passes on the last telegram if it ended before `at`.
  void finish_before(Tick at) {
    if (open_ && open_->end < at) finish();
  }

  static constexpr std::size_t kMostRemarks = 16;  ///< per telegram; further ones are dropped
  static constexpr std::size_t kMostBytes = 4096;  ///< per telegram: endless noise is split into several

 private:
  void begin(const WireTelegram& telegram);
  void take_flags();
  void add(const Flag& flag);

  TakeTelegram take_;
  std::optional<CapturedTelegram> open_;
  std::vector<Flag> flags_;  ///< not assigned to a telegram yet
};

}  // namespace dsdpv1::bus::capture

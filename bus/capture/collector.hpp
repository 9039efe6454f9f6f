#pragma once
// Captured telegrams out of what a monitor tells of the line.
#include <string>
#include <utility>
#include <vector>

#include "bus/capture/captured_telegram.hpp"
#include "bus/monitor/monitor.hpp"

namespace dsdpv1::bus::capture {

/// Holds a telegram until the next one begins: what was flagged meanwhile, and the characters after a wrong byte, are
/// its own.
class Collector {
 public:
  explicit Collector(TakeTelegram take) : take_(std::move(take)) {}

  void telegram(const WireTelegram& telegram);
  void flagged(const Flag& flag);
  void skipped(const ReceivedCharacter& character, int baud);
  /// The last one is taken.
  void finish();

  static constexpr std::size_t kMostRemarks = 16;  ///< of one telegram; what is beyond is left out
  static constexpr std::size_t kMostBytes = 4096;  ///< of one telegram: noise without an end goes into several

 private:
  void begin(const WireTelegram& telegram);
  void take_flags();
  void add(const Flag& flag);

  TakeTelegram take_;
  std::optional<CapturedTelegram> open_;
  std::vector<Flag> flags_;  ///< not yet given to a telegram
};

}  // namespace dsdpv1::bus::capture

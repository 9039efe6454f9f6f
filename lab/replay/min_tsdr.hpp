#pragma once
// The min_TSDR of a recorded slave, from its masters' Set_Prm.
#include <cstdint>
#include <optional>
#include <set>

#include "bus/baud.hpp"
#include "lab/replay/recording.hpp"

namespace dsdpv1::tb::replay {

class MinTsdr {
 public:
  /// `baud`: index of bus/baud.hpp.
  explicit MinTsdr(int baud) : baud_(baud) {}

  /// A request to the slave, in order of time; `answer` null if it was silent.
  void take(const bus::Telegram& request, const RecordedTelegram* answer);
  /// The least that may be in force for the answer to the last request, bit times.
  int least() const { return *possible_.begin(); }

 private:
  void set_prm(const bus::Telegram& request, const RecordedTelegram* answer);
  int within_limits(std::uint8_t bits) const;

  int baud_;
  std::set<int> possible_ = {bus::kMinTsdrBits};
  std::optional<int> asked_;  ///< by an acknowledged Set_Prm, accepted or not
};

}  // namespace dsdpv1::tb::replay

#pragma once
// Facts from earlier telegrams that explain later ones: the DPV1 setting of a slave, and the channels of MSAC2.
#include <array>
#include <cstdint>
#include <optional>
#include <set>

#include "bus/telegram/explain.hpp"

namespace dsdpv1::bus {

class ExplainMemory {
 public:
  /// Takes a right telegram, in order of time. Returns the context in which it is to be explained.
  ExplainContext take(const Telegram& telegram);

 private:
  /// Both ends of a connection of class 2.
  struct Channel {
    std::uint8_t slave = 0, slave_sap = 0, master = 0, master_sap = 0;
    bool operator<(const Channel& other) const;
  };
  bool take_channel(const Channel& channel, const Telegram& telegram);
  void open(Channel channel, std::uint8_t slave_sap);

  std::array<std::optional<bool>, 128> dpv1_ = {};  ///< by slave
  std::set<Channel> channels_;
};

}  // namespace dsdpv1::bus

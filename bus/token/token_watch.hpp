#pragma once
// The token as observed by a listener: its holder, its rotation time, and masters that send without it.
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "bus/telegram/telegram.hpp"
#include "bus/time.hpp"
#include "bus/token/rotation.hpp"

namespace dsdpv1::bus {

class TokenWatch {
 public:
  /// A token or a request on the wire: its times, and the idle time before it. Without a token on the line all may
  /// send; a master that passes it to itself holds it. After 6 x `slot` of silence any master may have claimed the
  /// token (EN 50170: T_TO), and the previous holder may repeat it while its receiver is silent.
  /// Returns the violation as text.
  std::optional<std::string> hear(const Telegram& telegram, Tick end, Tick quiet, Tick slot);

  /// T_RR by the master's address: from the end of a token to it to the end of the next; repeated tokens and the time
  /// outside the ring do not count.
  const std::map<std::uint8_t, RotationStatistics>& rotations() const { return rotations_; }
  /// The holder of the token, if known.
  std::optional<std::uint8_t> holder() const { return holder_; }

 private:
  bool may_send(const Telegram& telegram, Tick quiet, Tick slot) const;
  void passed(const Telegram& token, Tick end);

  std::optional<std::uint8_t> holder_, passer_;
  bool holder_heard_ = false;  ///< since it got the token
  bool several_ = false;       ///< the token has passed between two masters
  std::map<std::uint8_t, Tick> received_;
  std::map<std::uint8_t, RotationStatistics> rotations_;
};

}  // namespace dsdpv1::bus

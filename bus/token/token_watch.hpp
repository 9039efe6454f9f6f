#pragma once
// The token as a listener sees it: who has it, how long it takes to come round, who talks without it.
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
  /// A token or a request on the wire: its times, and the idle time in front of it. Requests are held against the token
  /// only since one has gone from one master to another: a single master may send what it likes. After 6 x `slot` of
  /// silence anybody may have claimed the token (EN 50170: T_TO), and who passed the token may repeat it while its
  /// receiver is silent. Returns what is wrong, in words.
  std::optional<std::string> hear(const Telegram& telegram, Tick end, Tick quiet, Tick slot);

  /// T_RR by the master's address: from the end of a token to it to the end of the next; repeated tokens do not count,
  /// nor the time that a master was out of the ring.
  const std::map<std::uint8_t, RotationStatistics>& rotations() const { return rotations_; }
  /// Who has the token as far as is known.
  std::optional<std::uint8_t> holder() const { return holder_; }

 private:
  bool may_send(const Telegram& telegram, Tick quiet, Tick slot) const;
  void passed(const Telegram& token, Tick end);

  std::optional<std::uint8_t> holder_, passer_;
  bool holder_heard_ = false;  ///< since it got the token
  bool several_ = false;       ///< a token has gone from one master to another
  std::map<std::uint8_t, Tick> received_;
  std::map<std::uint8_t, RotationStatistics> rotations_;
};

}  // namespace dsdpv1::bus

#pragma once
// The user's last access at the host port, or telegram at a serial one, read from its pins.
#include <string>

#include "kinds/dsdpv1/port/last_telegram.hpp"
#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::tb {

/// A read counts from the fall of RD, a write from the rise of WR, each while CSR is low.
class LastAccess {
 public:
  /// Every change of an input pin, in order of time.
  void pin(dsdpv1::Tick at, dsdpv1::Pin pin, dsdpv1::Level level);
  /// "read B410 at cycle 84795 + 122 ticks (1766.573 us)", "write B011 := 01 at ...", "none"; or as LastTelegram has
  /// it.
  std::string words() const;

 private:
  LastTelegram telegram_;
  dsdpv1::Tick at_ = -1;
  bool write_ = false;
  dsdpv1::Level address_ = 0, data_ = 0;                 ///< of the access
  dsdpv1::Level csr_ = 1, a_ = 0, d_ = dsdpv1::kLevelZ;  ///< at the pins
};

}  // namespace dsdpv1::tb

#pragma once
// The user's half of the DPRAM handshake (5.1, figure 4; ruling P9): R_REQ and R_STA as the logic sees them, two edges
// after the pins.
#include <algorithm>

#include "model/profibus/synchroniser.hpp"

namespace dsdpv1 {

using profibus::Cycle;
using profibus::Tick;

class Handshake {
 public:
  void set_r_req(Tick at, bool level) { r_req_.set(at, level); }
  void set_r_sta(Tick at, bool level) { r_sta_.set(at, level); }

  /// The rising edge of `now`; also in reset.
  void eval(Cycle now) {
    r_req_.eval(now);
    r_sta_.eval(now);
  }
  Cycle next() const { return std::min(r_req_.next(), r_sta_.next()); }

  bool r_req() const { return r_req_.level(); }
  bool r_sta() const { return r_sta_.level(); }
  /// H1: the chip keeps off the DPRAM while one of the two is high.
  bool user_holds() const { return r_req() || r_sta(); }

  template <class Archive>
  void store(Archive& archive) {
    auto& [req, sta] = *this;
    archive(req, sta);
  }

 private:
  profibus::Synchroniser r_req_{false}, r_sta_{false};
};

}  // namespace dsdpv1

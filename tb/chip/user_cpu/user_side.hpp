#pragma once

namespace dsdpv1::user_cpu {

/// A user CPU's interface to its chip. Each kind of chip derives its own.
struct UserSide {
  virtual ~UserSide() = default;
};

}  // namespace dsdpv1::user_cpu

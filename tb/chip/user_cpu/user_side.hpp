#pragma once

namespace dsdpv1::user_cpu {

/// What a user CPU has hold of at its chip. Each kind of chip derives its own.
struct UserSide {
  virtual ~UserSide() = default;
};

}  // namespace dsdpv1::user_cpu

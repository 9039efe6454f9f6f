#pragma once
// The reference RTL as one more twin of a chip under test. A separate core runs beside it. Every change of
// an output pin, and the DPRAM after each access that can have changed it, is compared as in co-simulation. A test's
// expectations of the chip thus apply to the RTL.
#include <memory>

#include "bus/time.hpp"
#include "model/dsdpv1/config.hpp"
#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::cosim {
class Lockstep;
}

namespace dsdpv1::conformance {

class RtlTwin {
 public:
  /// The twin of a chip with this configuration. Null without DSDPV1_RTL_TWIN in the environment, which is the number
  /// of the single fault that the RTL has, 0 for none.
  static std::unique_ptr<RtlTwin> make(const Config& config);

  explicit RtlTwin(std::unique_ptr<cosim::Lockstep> lockstep);
  ~RtlTwin();
  RtlTwin(const RtlTwin&) = delete;
  RtlTwin& operator=(const RtlTwin&) = delete;

  void set(bus::Tick at, Pin pin, Level level);
  /// Up to `at`. The first difference fails the test, in words.
  void compare(bus::Tick at);

 private:
  std::unique_ptr<cosim::Lockstep> lockstep_;
  bool differs_ = false;
};

}  // namespace dsdpv1::conformance

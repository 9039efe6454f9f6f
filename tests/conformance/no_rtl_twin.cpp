// Without the reference RTL no chip has such a twin, and none of this is called.
#include "tests/conformance/rtl_twin.hpp"

namespace dsdpv1 {
namespace cosim {
class Lockstep {};
}  // namespace cosim

namespace conformance {

std::unique_ptr<RtlTwin> RtlTwin::make(const Config&) { return nullptr; }
RtlTwin::RtlTwin(std::unique_ptr<cosim::Lockstep>) {}
RtlTwin::~RtlTwin() = default;
void RtlTwin::set(bus::Tick, Pin, Level) {}
void RtlTwin::compare(bus::Tick) { differs_ = true; }

}  // namespace conformance
}  // namespace dsdpv1

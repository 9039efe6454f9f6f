// C functions and objects are outside every namespace: here they get names without the common prefix.
#pragma once

namespace dsdpv1 {
namespace bus {}
namespace capi {}
namespace checks {}
namespace cosim {}
namespace profibus {}
namespace tb {}
}  // namespace dsdpv1

namespace bus = dsdpv1::bus;
namespace capi = dsdpv1::capi;
namespace checks = dsdpv1::checks;
namespace cosim = dsdpv1::cosim;
namespace profibus = dsdpv1::profibus;
namespace tb = dsdpv1::tb;

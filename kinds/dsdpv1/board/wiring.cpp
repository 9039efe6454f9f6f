#include "kinds/dsdpv1/board/wiring.hpp"

#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::tb {

arm::Wiring dsdpv1_wiring(unsigned card) {
  arm::Wiring wiring;
  wiring.interrupt_name = "INTR0";
  wiring.handshake = {number(Pin::kLReq), number(Pin::kLSta)};
  wiring.lamps = {number(Pin::kPbf), number(Pin::kBr), number(Pin::kReady)};
  wiring.miso = number(Pin::kMiso);
  wiring.interrupt = card == 2 ? arm::PortPin{arm::kD, 12} : arm::PortPin{arm::kG, 6};
  if (card == 2) wiring.reset = {arm::kE, 5};
  return wiring;
}

}  // namespace dsdpv1::tb

#pragma once
// The mailbox as a kind of chip, with the firmware of its user CPU. It is not a real chip: it tests model/profibus/ and
// the kit with a user's side that has nothing in common with a dual-port RAM.
#include "tb/kit/slave_kit.hpp"
#include "tests/mailbox/pins.hpp"

namespace dsdpv1::mailbox {

/// The SPI controller, under `user_cpu`.
struct UserSettings : tb::OwnSettings {
  Tick sck_period = 1200;  ///< an even number, and at least 500: XSS is high for it between two frames
};

const kit::Kind& kind();

}  // namespace dsdpv1::mailbox

#pragma once
// The pins of the mailbox, each one wire.
#include "tb/kit/slave_kit.hpp"

namespace dsdpv1::mailbox {

using kit::Cycle;
using kit::kReleased;
using kit::Level;
using kit::PinNumber;
using kit::Tick;

enum Pin : PinNumber {
  kXss = kit::kOwn,  ///< low-active: selects the SPI port
  kSck,
  kMosi,
  kMiso,  ///< kReleased while not selected
  kInt,   ///< low-active: unread outputs
};

}  // namespace dsdpv1::mailbox

#pragma once
// The pins of an XGate-DPS10 on the bench. TXD is also MOSI's pin and RXD also NSS's on the module (2.2): here each
// function has a pin, and those of the other port rest.
#include <vector>

#include "tb/kit/slave_kit.hpp"

namespace dsdpv1::xgate {

enum BenchPin : kit::PinNumber {
  kHostRxd = kit::kOwn,  ///< the host's bytes by UART
  kHostTxd,
  kNss,  ///< low-active: selects SPI
  kSck,
  kMosi,
  kMiso,    ///< released while not selected
  kInt,     ///< low-active
  kIspCfg,  ///< low-active
  kLed1A,   ///< red of LED1; 1: lit
  kLed1B,   ///< green of LED1
  kLed2A,   ///< green of LED2
  kLed2B,   ///< red of LED2
};

/// In the order of BenchPin.
std::vector<kit::Pin> bench_pins();

}  // namespace dsdpv1::xgate

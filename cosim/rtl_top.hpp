#pragma once
// A chip in RTL as the harness evaluates it: levels in, levels out. One implementation for each Verilated design.
//
// The reference RTL stands in shared libraries of its own (reference_rtl.hpp), so nothing in here may need code of the
// program.
#include <array>
#include <cstddef>
#include <cstdint>

namespace dsdpv1::cosim {

constexpr std::size_t kDpramSize = 2048;
using DpramImage = std::array<std::uint8_t, kDpramSize>;

/// Levels at the input pins, as the chip's (table 1, R2): RESET, CSR, RD, WR and XSS low-active.
struct RtlInputs {
  bool clk = false, reset = false, r_req = false, r_sta = false, csr = true, rd = true, wr = true, pbrxd = true;
  std::uint16_t a = 0;  ///< 0..0x7FF
  std::uint8_t d = 0;   ///< what the user drives; what a released bus reads as while nobody does
  // of the DSDPV1-RSU
  bool xss = true, sck = false, mosi = false, rxd = true;
  std::uint8_t mode = 0, adr = 0, ubr = 0, uiv = 0;
};

/// Output wires: places in the word of RtlOutputs. D is in bits 0 to 7, 0 while it is released.
enum Wire : unsigned {
  kWireLReq = 8,
  kWireLSta,
  kWireIntr0,
  kWirePbtxd,
  kWirePbrts,
  kWirePbf,
  kWireBr,
  kWireReady,
  kWireDriven,
  kWireMiso,  ///< DSDPV1-RSU: the pin's register, `spi_miso_delay` before the pin
  kWireMisoDriven,
  kWireTxd
};

/// Levels at the output pins, all in one word, so that a change of any is seen at once.
struct RtlOutputs {
  std::uint32_t word = 0;
  std::uint32_t unknown = 0;  ///< wires that are X, as far as the design tells

  bool operator==(const RtlOutputs& other) const { return word == other.word && unknown == other.unknown; }
};

class RtlTop {
 public:
  virtual ~RtlTop() = default;
  /// Lets the design settle with `in`, edges of the strobes and of the clock included, and leaves the result in `out`.
  virtual void eval() = 0;
  /// The content of the DPRAM, writes that have settled and are still on their way included; false: it cannot be seen.
  virtual bool dpram(DpramImage& image) const = 0;

  RtlInputs in;
  RtlOutputs out;
};

}  // namespace dsdpv1::cosim

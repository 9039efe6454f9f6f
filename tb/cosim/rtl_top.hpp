#pragma once
// A chip in RTL as the harness evaluates it: levels in, levels out. One implementation for each Verilated design.
#include <array>
#include <cstdint>

namespace cosim {

constexpr std::size_t kDpramSize = 2048;
using DpramImage = std::array<std::uint8_t, kDpramSize>;

/// Levels at the input pins, as the chip's (table 1): RESET, CSR, RD and WR low-active.
struct RtlInputs {
  bool clk = false, reset = false, r_req = false, r_sta = false, csr = true, rd = true, wr = true, pbrxd = true;
  std::uint16_t a = 0;  ///< 0..0x7FF
  std::uint8_t d = 0;   ///< what the user drives; what a released bus reads as while nobody does
};

/// Levels at the output pins, likewise.
struct RtlOutputs {
  bool l_req = false, l_sta = false, intr0 = false, pbtxd = false, pbrts = false, pbf = false, br = false,
       ready = false;
  bool d_oe = false;   ///< the chip drives D
  std::uint8_t d = 0;  ///< ... with this
  std::uint32_t unknown = 0;  ///< wires that are X, as far as the design tells; places as in `packed`

  static constexpr unsigned kFirstBit = 8;  ///< D is in bits 0 to 7, then the single wires in the order above
  static constexpr unsigned kDriven = kFirstBit + 8;

  /// All of them in one word, to see quickly whether anything has changed.
  std::uint32_t packed() const {
    const bool bits[] = {l_req, l_sta, intr0, pbtxd, pbrts, pbf, br, ready, d_oe};
    std::uint32_t word = d_oe ? d : 0U;
    for (unsigned i = 0; i < 9; ++i) word |= static_cast<std::uint32_t>(bits[i]) << (kFirstBit + i);
    return word;
  }
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

}  // namespace cosim

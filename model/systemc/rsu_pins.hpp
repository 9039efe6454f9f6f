#pragma once
// The DSDPV1-RSU as a SystemC module with the pins of table 1 and those of its serial ports (R2).
//
//   dsdpv1::systemc::RsuPinModule chip("chip");
//   chip.MODE(mode); chip.ADR(adr); chip.UBR(ubr); chip.UIV(uiv);      // straps: signals of their level
//   chip.XSS(xss); chip.SCK(sck); chip.MOSI(mosi); chip.MISO(miso); chip.RXD(rxd); chip.TXD(txd);
//   chip.RESET(reset); ...                                             // and those of PinModule
//
// Ports, timing and examples: docs/systemc.md.
#include "model/systemc/dsdpv1_pins.hpp"

namespace dsdpv1::systemc {

/// All inputs and MISO must be bound, also those of unused ports, which the chip ignores (R14). A strap's level counts
/// at the end of a reset. Inputs that change in one delta cycle with others of the parallel port are applied before
/// those; among themselves, and relative to CLK, the order does not matter.
class RsuPinModule : public PinModule {
 public:
  In<bool> XSS{"XSS"};                    ///< low-active, idle high
  In<bool> SCK{"SCK"}, MOSI{"MOSI"};      ///< SCK idles low
  sc_core::sc_out_resolved MISO{"MISO"};  ///< Z while released (R14)
  In<bool> RXD{"RXD"};                    ///< idle high
  Out TXD{"TXD"};                         ///< idle high
  In<sc_dt::sc_uint<2>> MODE{"MODE"};     ///< 0 parallel, 1 SPI, 2 UART
  In<sc_dt::sc_uint<2>> ADR{"ADR"};       ///< the card's address, 1 or 2
  In<sc_dt::sc_uint<3>> UBR{"UBR"};       ///< baud rate of the UART (UA1)
  In<sc_dt::sc_uint<3>> UIV{"UIV"};       ///< interval between its characters (UA3)

  explicit RsuPinModule(const sc_core::sc_module_name& name, const PinOptions& options = {});

 private:
  void end_of_elaboration() override;
  void apply_inputs(Tick at, bool first) override;
  void drive_pins(std::uint32_t pins) override;
  void plan_between_edges(Tick now) override;
  const char* title() const override { return has_clock() ? "RsuPinModule with CLK" : "RsuPinModule"; }

  sc_core::sc_event between_edges_{"between_edges"};
};

}  // namespace dsdpv1::systemc

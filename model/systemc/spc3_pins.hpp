#pragma once
// A chip of the SPC3 family as a SystemC module with the pins of its manual's table 2.1.
//
//   dsdpv1::systemc::Spc3PinModule chip("chip");
//   chip.RESET(reset); chip.XCS(xcs); ...          // CLK may be left unbound
//
// Ports, timing and examples: docs/systemc.md.
#include <array>
#include <cstdint>
#include <systemc>
#include <utility>

#include "model/systemc/pin_module.hpp"
#include "model/systemc/spc3_module.hpp"

namespace dsdpv1::systemc {

struct Spc3PinOptions : Spc3Options, ClockOptions {};

/// CLK and time: see PinsOf. CLK is 48 MHz, also of an SPC3 with `clock` 24. Ports have the names of
/// model/spc3/pins.inc; inputs must be bound. CLKOUT2/4 has none (A43).
/// AB11 and the pins of SPI are those of a VPC3+; they may be left unbound, an input is then at rest (A59).
///
/// Inputs that change in one delta cycle are applied in the order of that table: the end of a strobe takes AB and DB as
/// they were.
class Spc3PinModule : public PinsOf<Spc3Module> {
 public:
  In<bool> RESET{"RESET"};                                                  ///< high-active
  In<bool> XINT_MOT{"XINT_MOT"}, MODE{"MODE"};                              ///< straps: the bus (table 6.1)
  In<bool> DIVIDER{"DIVIDER"};                                              ///< strap, without effect (A43)
  In<bool> XTEST0{"XTEST0"}, XTEST1{"XTEST1"};                              ///< at VDD
  In<bool> XCS{"XCS"};                                                      ///< low-active
  In<bool> XRD_R_W{"XRD_R_W"}, XWR_E_CLOCK{"XWR_E_CLOCK"};                  ///< XRD/R_W, XWR/E_CLOCK
  In<bool> ALE_AS{"ALE_AS"};                                                ///< ALE/AS
  In<sc_dt::sc_uint<11>> AB{"AB"};                                          ///< 0..0x7FF
  sc_core::sc_inout_rv<8> DB{"DB"};                                         ///< Z while released, X while unknown (A42)
  In<bool> RXD{"RXD"};                                                      ///< idle high
  In<bool> XCTS{"XCTS"};                                                    ///< low: clear to send
  Out XREADY_XDTACK{"XREADY_XDTACK"};                                       ///< XREADY/XDTACK, low-active
  Out X_INT{"X_INT"};                                                       ///< X/INT; its active level: INT_Pol
  Out XDATAEXCH{"XDATAEXCH"};                                               ///< low in DATA_EX
  Out TXD{"TXD"}, RTS{"RTS"};                                               ///< idle high; driver enable (P2)
  OptionalIn AB11{"AB11"};                                                  ///< above AB
  OptionalIn SERIAL{"SERIAL"};                                              ///< strap: high for SPI
  OptionalIn SCK{"SCK"}, MOSI{"MOSI"}, XSS{"XSS"};                          ///< XSS is low-active
  OptionalPort<sc_core::sc_signal_inout_if<sc_dt::sc_logic>> MISO{"MISO"};  ///< Z while released

  explicit Spc3PinModule(const sc_core::sc_module_name& name, const Spc3PinOptions& options = {});

 private:
  void end_of_elaboration() override;
  void begin_inputs() override;
  void apply_inputs(Tick at, bool first) override;
  void drive_pins(std::uint32_t pins) override;
  const char* title() const override { return has_clock() ? "Spc3PinModule with CLK" : "Spc3PinModule"; }

  /// Inputs of one wire, in the order of the table.
  const std::array<std::pair<spc3::Pin, In<bool>*>, 12> inputs_;
  const std::array<std::pair<spc3::Pin, OptionalIn*>, 5> optional_inputs_;
  bool user_drives_db_ = true;           ///< the chip does not
  spc3::Level user_db_ = spc3::kLevelZ;  ///< last level of DB from the user
};

}  // namespace dsdpv1::systemc

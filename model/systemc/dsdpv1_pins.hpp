#pragma once
// The chip as a SystemC module with the pins of table 1.
//
//   dsdpv1::systemc::PinModule chip("chip");
//   chip.RESET(reset); chip.R_REQ(r_req); ...    // CLK may be left unbound
//
// Ports, timing and examples: docs/systemc.md.
#include <cstdint>
#include <systemc>

#include "model/systemc/chip_module.hpp"
#include "model/systemc/pin_module.hpp"

namespace dsdpv1::systemc {

struct PinOptions : ChipOptions, ClockOptions {};

/// The DSDPV1 or the DSDPV1-R; RsuPinModule (rsu_pins.hpp) is the DSDPV1-RSU. CLK and time: see PinsOf.
///
/// Inputs that change in one delta cycle are applied in this order: A and D, then CSR, RD, WR, and last the end of an
/// access (CSR, R_REQ, R_STA released).
class PinModule : public PinsOf<ChipModule> {
 public:
  In<bool> RESET{"RESET"};                   ///< low-active
  In<bool> R_REQ{"R_REQ"}, R_STA{"R_STA"};   ///< the user's side of the handshake
  In<bool> CSR{"CSR"}, RD{"RD"}, WR{"WR"};   ///< low-active
  In<sc_dt::sc_uint<11>> A{"A"};             ///< 0..0x7FF
  sc_core::sc_inout_rv<8> D{"D"};            ///< Z while released, X while unknown (P5)
  Out L_REQ{"L_REQ"}, L_STA{"L_STA"};        ///< the chip's side of the handshake
  Out INTR0{"INTR0"};                        ///< falls on new parameters or configuration (P7)
  In<bool> PBRXD{"PBRXD"};                   ///< idle high
  Out PBTXD{"PBTXD"}, PBRTS{"PBRTS"};        ///< idle high; driver enable (P2)
  Out PBF{"PBF"}, BR{"BR"}, READY{"READY"};  ///< LEDs, high is lit (P3)

  explicit PinModule(const sc_core::sc_module_name& name, const PinOptions& options = {});

 protected:
  void end_of_elaboration() override;
  void begin_inputs() override;
  void apply_inputs(Tick at, bool first) override;
  void drive_pins(std::uint32_t pins) override;
  const char* title() const override { return has_clock() ? "PinModule with CLK" : "PinModule"; }

 private:
  void apply_host(Tick at);

  bool user_drives_d_ = true;  ///< the chip does not drive it
  Level user_d_ = kLevelZ;     ///< last level of D from the user
};

}  // namespace dsdpv1::systemc

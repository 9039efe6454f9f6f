#pragma once
// The chip as a SystemC module with the pins of table 1.
//
//   dsdpv1::systemc::PinModule chip("chip");
//   chip.RESET(reset); chip.R_REQ(r_req); ...    // CLK may be left unbound
//
// Ports, timing and examples: docs/systemc.md.
#include <cstdint>
#include <memory>
#include <systemc>

#include "model/systemc/bound_clock.hpp"
#include "model/systemc/chip_module.hpp"

namespace dsdpv1::systemc {

struct PinOptions : ChipOptions {
  /// (p) A bound CLK whose mean over BoundClock::kWindow edges deviates more from 48 MHz is reported once as
  /// /dsdpv1/clock. The default is the 0.3 % that EN 50170 allows for a station's bit rate.
  double clock_tolerance_ppm = 3000;
};

/// The DSDPV1 or the DSDPV1-R; RsuPinModule (rsu_pins.hpp) is the DSDPV1-RSU.
///
/// CLK unbound: the rising edge of cycle n is at simulation tick n * 250 + phase, and only changes of pins cost events.
/// CLK bound: cycle n is its n-th rising edge, counted from 0; `phase` is not used.
///
/// An input that changes at the time of a rising edge is seen by the next one (ruling P9). The levels at the end of
/// time 0 are the initial ones: delta cycles at time 0 are not edges. Inputs that change in one delta cycle are applied
/// in this order: A and D, then CSR, RD, WR, and last the end of an access (CSR, R_REQ, R_STA released).
class PinModule : public ChipModule {
 public:
  template <class T>
  using In = sc_core::sc_in<T>;
  using Out = sc_core::sc_out<bool>;

  /// 48 MHz, optional.
  sc_core::sc_port<sc_core::sc_signal_in_if<bool>, 1, sc_core::SC_ZERO_OR_MORE_BOUND> CLK{"CLK"};
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
  /// Applies inputs that have changed; all of them the `first` time.
  virtual void apply_inputs(Tick at, bool first);
  virtual void drive_pins(std::uint32_t pins);

 private:
  /// CLK is bound, the chip is at `now`: plans events between two edges of CLK.
  virtual void plan_between_edges(Tick /*now*/) {}
  void evaluate();
  void evaluate_core();
  void begin();
  void clock_edge();
  void check_clock();
  Tick present() const;
  void apply_host(Tick at);

  double clock_tolerance_ppm_;
  std::unique_ptr<BoundClock> clock_;  ///< only while CLK is bound
  bool applied_ = false;               ///< the initial levels
  bool user_drives_d_ = true;          ///< the chip does not drive it
  Level user_d_ = kLevelZ;             ///< last level of D from the user
};

}  // namespace dsdpv1::systemc

// The pin module with signals of a bench: out of reset, until it reports that it works (D1).
#include <systemc>

#include "model/systemc/dsdpv1_pins.hpp"
#include "registers/dsdpv1_regs.hpp"

namespace {

struct Bench {
  sc_core::sc_signal<bool> reset, r_req, r_sta, csr, rd, wr, pbrxd;
  sc_core::sc_signal<sc_dt::sc_uint<11>> a;
  sc_core::sc_signal_rv<8> d;
  sc_core::sc_signal<bool> l_req, l_sta, intr0, pbtxd, pbrts, pbf, br, ready;
  dsdpv1::systemc::PinModule chip{"chip"};

  Bench() {
    bind_inputs();
    bind_outputs();
    for (auto* high : {&csr, &rd, &wr, &pbrxd}) high->write(true);
  }

  void bind_inputs() {
    chip.RESET(reset);
    chip.R_REQ(r_req);
    chip.R_STA(r_sta);
    chip.CSR(csr);
    chip.RD(rd);
    chip.WR(wr);
    chip.A(a);
    chip.D(d);
    chip.PBRXD(pbrxd);
  }

  void bind_outputs() {
    chip.L_REQ(l_req);
    chip.L_STA(l_sta);
    chip.INTR0(intr0);
    chip.PBTXD(pbtxd);
    chip.PBRTS(pbrts);
    chip.PBF(pbf);
    chip.BR(br);
    chip.READY(ready);
  }
};

}  // namespace

int sc_main(int, char**) {
  sc_core::sc_set_time_resolution(1, sc_core::SC_FS);
  Bench bench;
  sc_core::sc_start(1, sc_core::SC_US);
  bench.reset.write(true);
  sc_core::sc_start(200, sc_core::SC_US);
  return bench.chip.peek(dsdpv1::regs::kValidFlag) == dsdpv1::regs::kValidFlagValid ? 0 : 1;
}

#pragma once
// Between wires of sc_logic, as a netlist or a mixed-language simulator has them, and the modules' ports of bool.
//
//   dsdpv1::systemc::FromLogic r_req("r_req", false);
//   r_req.in(net_r_req), r_req.out(wire), chip.R_REQ(wire);
//   dsdpv1::systemc::ToLogic l_req("l_req");
//   chip.L_REQ(other_wire), l_req.in(other_wire), l_req.out(net_l_req);
#include <string>
#include <systemc>

#include "model/systemc/has_process.hpp"

namespace dsdpv1::systemc {

/// `out` follows `in` a delta cycle later. Z and X are the level of the board's pull resistor. An X after the first 0
/// or 1 is reported, once, as the warning /dsdpv1/logic.
class FromLogic : public sc_core::sc_module {
 public:
  sc_core::sc_in<sc_dt::sc_logic> in{"in"};
  sc_core::sc_out<bool> out{"out"};

  FromLogic(const sc_core::sc_module_name& name, bool pull) : sc_module(name), pull_(pull) {
    DSDPV1_HAS_PROCESS(FromLogic);
    SC_METHOD(follow);
    sensitive << in;
  }

 private:
  void follow() {
    const sc_dt::sc_logic level = in.read();
    known_ = known_ || level.is_01();
    if (known_ && !reported_ && level == sc_dt::SC_LOGIC_X) report();
    out.write(level.is_01() ? level.to_bool() : pull_);
  }
  void report() {
    reported_ = true;
    SC_REPORT_WARNING("/dsdpv1/logic", (std::string(name()) + ": X, read as " + (pull_ ? "1" : "0")).c_str());
  }

  bool pull_, known_ = false, reported_ = false;
};

/// `out` follows `in` a delta cycle later.
class ToLogic : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> in{"in"};
  sc_core::sc_out<sc_dt::sc_logic> out{"out"};

  explicit ToLogic(const sc_core::sc_module_name& name) : sc_module(name) {
    DSDPV1_HAS_PROCESS(ToLogic);
    SC_METHOD(follow);
    sensitive << in;
  }

 private:
  void follow() { out.write(sc_dt::sc_logic(in.read())); }
};

}  // namespace dsdpv1::systemc

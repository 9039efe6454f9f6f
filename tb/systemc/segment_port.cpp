#include "tb/systemc/segment_port.hpp"

#include "model/systemc/has_process.hpp"
#include "model/systemc/sim_time.hpp"

namespace dsdpv1::systemc_bench {

SegmentPort::SegmentPort(const sc_core::sc_module_name& name, bus::Segment& segment, TimelineModule& timeline)
    : sc_module(name), segment_(segment), timeline_(timeline), station_(segment.attach(sc_module::name(), this)) {
  PBRXD.initialize(true);
  DSDPV1_HAS_PROCESS(SegmentPort);
  SC_METHOD(drive);
  sensitive << PBTXD << PBRTS;
  dont_initialize();
  SC_METHOD(hear);  // the only process that writes PBRXD, whichever station has changed the line
  sensitive << heard_;
  dont_initialize();
}

void SegmentPort::drive() {
  segment_.drive(station_, dsdpv1::systemc::current_tick(), PBRTS.read(), PBTXD.read());
  timeline_.wake();
}

void SegmentPort::line_changed(bus::Tick /*at*/, bool /*level*/) {
  timeline_.catch_up();
  heard_.notify(sc_core::SC_ZERO_TIME);
}

}  // namespace dsdpv1::systemc_bench

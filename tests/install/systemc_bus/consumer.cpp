// A master on a segment in SystemC's time, and on the same segment the chip as a TLM module: out of reset it reports
// that it works (D1), searches the baud rate, and does not answer the master, because no user CPU gives it an address.
#include <tlm_utils/simple_initiator_socket.h>
#include <dsdpv1/bus/master/master1.hpp>
#include <dsdpv1/bus/monitor/monitor.hpp>
#include <dsdpv1/registers/dsdpv1_regs.hpp>
#include <dsdpv1/tb/systemc/segment_port.hpp>
#include <systemc>

namespace {

struct Nobody : sc_core::sc_module {
  tlm_utils::simple_initiator_socket<Nobody> socket{"socket"};
  explicit Nobody(const sc_core::sc_module_name& name) : sc_module(name) {}
};

}  // namespace

int sc_main(int, char**) {
  dsdpv1::bus::Segment segment;
  dsdpv1::bus::Timeline timeline;
  dsdpv1::bus::Master1 master(segment, dsdpv1::bus::MasterConfig{});
  dsdpv1::bus::Monitor monitor(segment);
  monitor.set_baud(0);
  timeline.add(master);
  timeline.add(monitor);
  dsdpv1::bus::SlaveParameters slave;
  slave.address = 3;
  slave.cfg = {0x11};
  master.add_slave(slave);
  master.start();

  dsdpv1::systemc_bench::TimelineModule agents("agents", timeline);
  dsdpv1::systemc_bench::SegmentPort line("line", segment, agents);
  dsdpv1::systemc::TlmModule chip("chip");
  Nobody user_cpu("user_cpu");
  sc_core::sc_signal<bool> reset, low, rxd("rxd", true), txd("txd", true), rts;
  user_cpu.socket.bind(chip.host_socket);
  chip.RESET(reset), chip.R_REQ(low), chip.R_STA(low);
  chip.PBRXD(rxd), chip.PBTXD(txd), chip.PBRTS(rts);
  line.PBRXD(rxd), line.PBTXD(txd), line.PBRTS(rts);
  sc_core::sc_start(1, sc_core::SC_US);
  reset.write(true);
  sc_core::sc_start(10, sc_core::SC_MS);
  const bool works = chip.peek(dsdpv1::regs::kValidFlag) == dsdpv1::regs::kValidFlagValid;
  const dsdpv1::bus::MonitorStatistics& heard = monitor.statistics();
  return works && heard.telegrams > 10 && heard.wrong == 0 &&
                 master.slave(3).state != dsdpv1::bus::SlaveState::kDataExchange
             ? 0
             : 1;
}

#pragma once
// A real master at a pseudo-terminal, a TCP port or a serial port, for the chips of a SystemC platform: the platform
// runs in real time.
//
//   namespace serve = dsdpv1::tb::serve;
//   dsdpv1::systemc_bench::SegmentModule line("line");
//   dsdpv1::systemc_bench::HostBridge host("host", serve::open_pty("dp", 19200), line, 8);  // 19.2 kbit/s
//
// As `dsdpv1-sim serve`, with the same code: docs/systemc.md.
#include <functional>
#include <memory>
#include <string>
#include <systemc>

#include "tb/serve/host_link.hpp"
#include "tb/serve/ports.hpp"
#include "tb/systemc/segment_module.hpp"

namespace dsdpv1::systemc_bench {

/// Simulation time follows real time from the first sc_start on (HostLink has the rules): the module sleeps in the
/// kernel's thread, so nothing else has to. A platform that is too slow is late, made up as long as it is 100 ms at
/// most; more is given up, and reported. While a telegram of the host is incomplete simulation time stands still.
class HostBridge : public sc_core::sc_module {
 public:
  /// `baud`: index in bus/baud.hpp. `line` must outlive it.
  HostBridge(const sc_core::sc_module_name& name, std::unique_ptr<tb::serve::HostConnection> port, SegmentModule& line,
             int baud);

  /// One line about the port: a host has come, gone, sends too fast. Default: SC_REPORT_INFO /dsdpv1/host.
  std::function<void(const std::string& text)> say;
  /// One line when time was given up, at most every 5 s. Default: SC_REPORT_WARNING /dsdpv1/late.
  std::function<void(const std::string& text)> late;
  /// Called after each slice, at most 1 ms apart: true pauses the simulation, and the host is no longer served.
  std::function<bool()> stopped = [] { return false; };
  /// Name of the port, telegrams and bytes, and how well time was kept.
  tb::Pacing pacing() const { return link_.pacing(); }

 private:
  void run();
  void slice();

  SegmentModule& line_;
  tb::serve::HostLink link_;
};

}  // namespace dsdpv1::systemc_bench

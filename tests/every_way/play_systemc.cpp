// play_systemc INPUTS OUTPUTS END FEMTOSECONDS: applies changes of inputs to the pin module in a simulation of this
// resolution and records the changes of its signals, each at the simulation time of its event. Lines of INPUTS: tick,
// pin, level; of OUTPUTS: time in units of the resolution, pin, level.
#include <fstream>
#include <iostream>

#include "tests/systemc/bench.hpp"

using dsdpv1::method_on;
using dsdpv1::Pin;
using dsdpv1::PinBench;
using dsdpv1::Tick;

namespace {

void write(std::ostream& out, Pin pin, int level) {
  out << sc_core::sc_time_stamp().value() << " " << static_cast<unsigned>(pin) << " " << level << "\n";
}

void record(Pin pin, sc_core::sc_signal<bool>& signal, std::ostream& out) {
  method_on(
      signal.value_changed_event(), [&out, &signal, pin] { write(out, pin, signal.read() ? 1 : 0); });
}

/// D as the chip drives it: while the user does, it does not.
int level_of_d(const PinBench& bench, bool user_drives) {
  const sc_dt::sc_lv<8> d = bench.d.read();
  if (user_drives || d == sc_dt::sc_lv<8>(sc_dt::SC_LOGIC_Z)) return -1;
  return d.is_01() ? static_cast<int>(d.to_uint()) : -2;
}

void play(PinBench& bench, std::istream& in, bool& user_drives) {
  Tick tick = 0;
  unsigned pin = 0;
  int level = 0;
  while (in >> tick >> pin >> level) {
    dsdpv1::wait_until(tick);
    if (static_cast<Pin>(pin) == Pin::kDIn) user_drives = level >= 0;
    bench.drive(static_cast<Pin>(pin), static_cast<dsdpv1::Level>(level));
  }
}

}  // namespace

int sc_main(int argc, char* argv[]) {
  if (argc != 5) return 2;
  sc_core::sc_set_time_resolution(std::stod(argv[4]), sc_core::SC_FS);
  std::ifstream in(argv[1]);
  std::ofstream out(argv[2]);
  PinBench bench("bench");
  bool user_drives = false;
  const std::pair<Pin, sc_core::sc_signal<bool>*> outputs[] = {
      {Pin::kLReq, &bench.l_req},  {Pin::kLSta, &bench.l_sta},  {Pin::kIntr0, &bench.intr0},
      {Pin::kPbtxd, &bench.pbtxd}, {Pin::kPbrts, &bench.pbrts}, {Pin::kPbf, &bench.pbf},
      {Pin::kBr, &bench.br},       {Pin::kReady, &bench.ready}};
  for (const auto& [pin, signal] : outputs) record(pin, *signal, out);
  method_on(
      bench.d.value_changed_event(), [&] { write(out, Pin::kDOut, level_of_d(bench, user_drives)); });
  dsdpv1::thread([&] { play(bench, in, user_drives); });
  sc_core::sc_start(dsdpv1::systemc::to_time(std::stoll(argv[3])));
  return out.good() ? 0 : 1;
}

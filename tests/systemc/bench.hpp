#pragma once
// Shared by the SystemC benches: a simulation runs once, before the tests, which check its records.
#include <cstdlib>
#include <ostream>
#include <string>
#include <systemc>
#include <utility>
#include <vector>

#include "model/systemc/dsdpv1_pins.hpp"
#include "model/systemc/dsdpv1_tlm.hpp"

namespace dsdpv1 {

/// Defined by every test program: builds its bench and runs it.
void simulate();

/// To be called first in `simulate`: 1 fs, or the number of fs in the environment (DSDPV1_RESOLUTION_FS: 1, 10, 100,
/// 1000; others for a refused resolution).
inline void set_resolution() {
  const char* femtoseconds = std::getenv("DSDPV1_RESOLUTION_FS");
  sc_core::sc_set_time_resolution(femtoseconds != nullptr ? std::strtod(femtoseconds, nullptr) : 1, sc_core::SC_FS);
}

constexpr dsdpv1::Tick kNs = 12;
constexpr dsdpv1::Tick kUs = 12'000;

/// A pin change as ChipModule::on_pin reports it.
struct Change {
  dsdpv1::Tick at;
  dsdpv1::Pin pin;
  dsdpv1::Level level;
  bool operator==(const Change& o) const { return at == o.at && pin == o.pin && level == o.level; }
};
inline std::ostream& operator<<(std::ostream& out, const Change& c) {
  return out << "tick " << c.at << " " << dsdpv1::name(c.pin) << " = " << c.level;
}
using Changes = std::vector<Change>;

inline Changes only(const Changes& all, dsdpv1::Pin pin) {
  Changes some;
  for (const Change& change : all)
    if (change.pin == pin) some.push_back(change);
  return some;
}

/// Collects SystemC's reports instead of printing them.
inline std::vector<std::pair<std::string, std::string>>& reports() {
  static std::vector<std::pair<std::string, std::string>> all;
  return all;
}
inline void collect_reports() {
  sc_core::sc_report_handler::set_handler([](const sc_core::sc_report& report, const sc_core::sc_actions& actions) {
    reports().emplace_back(report.get_msg_type(), report.get_msg());
    if ((actions & sc_core::SC_THROW) != 0) throw report;
  });
}
/// The texts of a module's reports of a type.
inline std::vector<std::string> reports_of(const std::string& type, const std::string& module) {
  std::vector<std::string> texts;
  for (const auto& [id, text] : reports())
    if (id == type && text.rfind(module + ":", 0) == 0) texts.push_back(text);
  return texts;
}

inline void wait_until(dsdpv1::Tick tick) {
  const sc_core::sc_time at = dsdpv1::systemc::to_time(tick);
  if (at > sc_core::sc_time_stamp()) sc_core::wait(at - sc_core::sc_time_stamp());
}

/// A pin module among its signals; its pins are recorded.
struct PinBench {
  sc_core::sc_signal<bool> reset, r_req, r_sta, csr, rd, wr, pbrxd;
  sc_core::sc_signal<sc_dt::sc_uint<11>> a;
  sc_core::sc_signal_rv<8> d;
  sc_core::sc_signal<bool> l_req, l_sta, intr0, pbtxd, pbrts, pbf, br, ready;
  dsdpv1::systemc::PinModule chip;
  Changes changes;

  explicit PinBench(const char* name, const dsdpv1::systemc::PinOptions& options = {}) : chip(name, options) {
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta), chip.CSR(csr), chip.RD(rd), chip.WR(wr), chip.A(a),
        chip.D(d);
    chip.PBRXD(pbrxd), chip.L_REQ(l_req), chip.L_STA(l_sta), chip.INTR0(intr0), chip.PBTXD(pbtxd), chip.PBRTS(pbrts);
    chip.PBF(pbf), chip.BR(br), chip.READY(ready);
    for (auto* high : {&csr, &rd, &wr, &pbrxd}) high->write(true);
    chip.on_pin = [this](dsdpv1::Tick at, dsdpv1::Pin pin, dsdpv1::Level level) {
      changes.push_back({at, pin, level});
    };
  }

  /// Sets each at its time, `shift` ticks later. Call it in a thread, as `drive`.
  void play(const Changes& inputs, Tick shift = 0) {
    for (const Change& c : inputs) {
      wait_until(c.at + shift);
      drive(c.pin, c.level);
    }
  }
  /// To be called from one process only: D counts its drivers by process.
  void drive(dsdpv1::Pin pin, dsdpv1::Level level) {
    const bool high = level != 0;
    switch (pin) {
      case Pin::kReset: reset.write(high); break;
      case Pin::kRReq: r_req.write(high); break;
      case Pin::kRSta: r_sta.write(high); break;
      case Pin::kCsr: csr.write(high); break;
      case Pin::kRd: rd.write(high); break;
      case Pin::kWr: wr.write(high); break;
      case Pin::kPbrxd: pbrxd.write(high); break;
      case Pin::kA: a.write(static_cast<unsigned>(level)); break;
      case Pin::kDIn:
        d.write(level < 0 ? sc_dt::sc_lv<8>(sc_dt::SC_LOGIC_Z) : sc_dt::sc_lv<8>(static_cast<int>(level)));
        break;
      default: break;
    }
  }
};

/// Makes a thread or method from a lambda.
template <class Body>
void thread(Body body) {
  sc_core::sc_spawn(body);
}
template <class Body>
void method_on(const sc_core::sc_event& event, Body body) {
  sc_core::sc_spawn_options options;
  options.spawn_method();
  options.dont_initialize();
  options.set_sensitivity(&event);
  sc_core::sc_spawn(body, nullptr, &options);
}

}  // namespace dsdpv1

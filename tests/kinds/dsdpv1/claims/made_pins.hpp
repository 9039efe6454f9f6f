#pragma once
// Captures made edge by edge, exact to the tick, and calibrate's results for them.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/kinds/dsdpv1/claims/made_capture.hpp"

namespace dsdpv1::calibrate_test {

/// Times are cycles of 48 MHz.
class MadePins {
 public:
  /// These wires are in the capture, with this level at its beginning.
  void show(const std::vector<Wire>& wires, bool level = false) {
    for (const Wire wire : wires) {
      trace(wire).seen = true;
      trace(wire).first = level;
    }
  }
  /// Edges of one wire are made in order of time.
  void set(double at, Wire wire, bool level) {
    calibrate::Trace& own = trace(wire);
    if (own.level(own.edges.size()) != level) own.edges.push_back(tick(at));
  }
  void high(Wire wire, double from, double to) {
    set(from, wire, true);
    set(to, wire, false);
  }
  void low(Wire wire, double from, double to) {
    set(from, wire, false);
    set(to, wire, true);
  }
  /// An access of the chip.
  void access(double at, double cycles) {
    for (const Wire wire : {wire::kLReq, wire::kLSta})
      if (trace(wire).seen) high(wire, at, at + cycles);
  }
  /// Accesses one interval of 48 cycles after the other, from `from` on as long as they begin before `to`.
  void accesses(double from, double to, double cycles = 7) {
    for (int i = 0; from + 48 * i < to; ++i) access(from + 48 * i, cycles);
  }
  void show_host_port() {
    show({wire::kCsr, wire::kRd, wire::kWr}, true);
    for (std::size_t i = 0; i < calibrate::kAddressWires; ++i) show({bit(wire::kA, i)});
    for (std::size_t i = 0; i < calibrate::kDataWires; ++i) show({bit(wire::kD, i)});
  }
  void number(double at, Wire first, std::size_t wires, unsigned value) {
    for (std::size_t i = 0; i < wires; ++i) set(at, bit(first, i), (value >> i & 1U) != 0);
  }
  /// RD (WR) and CSR low for so many cycles, A from a cycle before on; of a read D from 1.5 cycles on.
  void user(double at, bool write, unsigned address, unsigned data, double cycles = 6) {
    number(at - 1, wire::kA, calibrate::kAddressWires, address);
    number(write ? at : at + 1.5, wire::kD, calibrate::kDataWires, data);
    low(wire::kCsr, at, at + cycles);
    low(write ? wire::kWr : wire::kRd, at, at + cycles);
    if (!write) number(at + cycles, wire::kD, calibrate::kDataWires, 0xFF);  // released: it floats up
  }
  void read(double at, unsigned address, unsigned data) { user(at, false, address, data); }
  void write(double at, unsigned address, unsigned data) { user(at, true, address, data); }

  calibrate::Result judged(double end) {
    calibrate::Sampling sampling;
    sampling.rate = static_cast<double>(bus::kTicksPerSecond);
    sampling.jitter_ns = sampling.clock_ppm = 0;
    return judged(end, sampling);
  }
  /// ... of an analyser's samples: each edge shows at the next one. `rate` a second, a divisor of 12 GHz.
  calibrate::Result sampled(double end, double rate) {
    const auto period = static_cast<bus::Tick>(static_cast<double>(bus::kTicksPerSecond) / rate);
    for (calibrate::Trace& own : record_.traces) {
      std::vector<bus::Tick> seen;
      for (const bus::Tick edge : own.edges) {
        const bus::Tick at = (edge + period - 1) / period * period;
        if (!seen.empty() && seen.back() == at)
          seen.pop_back();  // between two samples
        else
          seen.push_back(at);
      }
      own.edges = std::move(seen);
    }
    calibrate::Sampling sampling;
    sampling.rate = rate;
    return judged(end, sampling);
  }

 private:
  calibrate::Result judged(double end, const calibrate::Sampling& sampling) {
    record_.end = tick(end);
    return calibrate::calibrate("made", record_, sampling, {}, *tb::chip_kinds().front());
  }
  static Wire bit(Wire first, std::size_t number) {
    return static_cast<Wire>(static_cast<std::size_t>(first) + number);
  }
  static bus::Tick tick(double cycles) {
    return static_cast<bus::Tick>(std::llround(cycles * static_cast<double>(bus::kTicksPerCycle)));
  }
  calibrate::Trace& trace(Wire wire) { return record_.traces.at(static_cast<std::size_t>(wire)); }

  calibrate::Record record_{calibrate::wires()};
};

}  // namespace dsdpv1::calibrate_test

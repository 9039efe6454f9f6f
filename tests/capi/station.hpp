#pragma once
// A slave on the bus of the C API: a chip initialised by its user, and a master's data about it.
#include "tests/bench/saturated_bus.hpp"
#include "tests/capi/capi.hpp"

namespace dsdpv1::capi_test {

constexpr int kBytes = 4;  ///< of inputs and of outputs
constexpr uint8_t kAddress = 5;

inline dpsim_slave slave_of_the_chip() {
  auto slave = sized<dpsim_slave>();
  const bus::Bytes cfg = speed::identifiers(kBytes);
  slave.address = kAddress;
  slave.ident = conformance::Init().ident;
  slave.input_length = slave.output_length = kBytes;
  slave.cfg_size = static_cast<uint16_t>(cfg.size());
  std::copy(cfg.begin(), cfg.end(), slave.cfg);
  return slave;
}

/// From the release of RESET to READY; the tick at which that is over.
inline uint64_t start_up(dpsim_chip* chip) {
  ok(dpsim_chip_set(chip, 10 * kCycle, DPSIM_DSDPV1_RESET, 1));
  uint64_t now = 6010 * kCycle;
  ok(dpsim_chip_set(chip, now, DPSIM_DSDPV1_R_REQ, 1));
  ok(dpsim_chip_set(chip, now += 100 * kCycle, DPSIM_DSDPV1_R_STA, 1));
  now += kCycle;
  for (const speed::Cell& cell : speed::initialisation(kBytes))
    ok(dpsim_chip_write(chip, now, cell.address, cell.value, nullptr, &now));
  ok(dpsim_chip_set(chip, now, DPSIM_DSDPV1_R_STA, 0));
  ok(dpsim_chip_set(chip, now, DPSIM_DSDPV1_R_REQ, 0));
  ok(dpsim_chip_advance(chip, now += 50 * kUs));
  dpsim_level ready = 0;
  ok(dpsim_chip_level(chip, DPSIM_DSDPV1_READY, &ready));
  EXPECT_EQ(ready, 1);
  return now;
}

inline dpsim_master* add_master(dpsim_bus* bus, uint8_t address = 2, int master_class = 1, bool ring = false) {
  auto options = sized<dpsim_master_options>();
  options.address = address;
  options.master_class = master_class;
  options.ring = ring ? 1 : 0;
  options.target_rotation_bits = 10'000;  // so that the GAP is polled repeatedly
  dpsim_master* master = nullptr;
  ok(dpsim_bus_add_master(bus, &options, &master));
  return master;
}

inline dpsim_chip* add_chip(dpsim_bus* bus) {
  dpsim_chip* chip = nullptr;
  ok(dpsim_bus_add_chip(bus, nullptr, &chip));
  return chip;
}

/// A bus with one chip and one master that knows it, both silent.
struct Line {
  explicit Line(bool ring = false) : master(add_master(bus.get(), 2, 1, ring)) {
    const dpsim_slave slave = slave_of_the_chip();
    ok(dpsim_master_add_slave(master, &slave));
  }
  /// The master begins at the same tick on each line.
  void begin() {
    start_up(chip);
    ok(dpsim_bus_run(bus.get(), kBegin));
    ok(dpsim_master_start(master));
  }
  dpsim_slave_state state() const {
    auto status = sized<dpsim_slave_status>();
    ok(dpsim_master_get_slave(master, kAddress, &status));
    return status.state;
  }

  static constexpr uint64_t kBegin = kMs / 2, kRunning = 4 * kMs;

  Owned<dpsim_bus> bus = make_bus();
  dpsim_chip* chip = add_chip(bus.get());
  dpsim_master* master;
};

}  // namespace dsdpv1::capi_test

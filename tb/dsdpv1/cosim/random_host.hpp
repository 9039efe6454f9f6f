#pragma once
// What the user of a random case does at a host port: the DPRAM taken and given, cells and blocks read and written, and
// things that nobody should do. One class for each port: parallel, SPI and UART.
#include <memory>

#include "model/dsdpv1/config.hpp"
#include "tb/dsdpv1/cosim/random_setup.hpp"

namespace dsdpv1::cosim {

class RandomHost {
 public:
  RandomHost(Random& random, Stimulus& stimulus) : random_(random), stimulus_(stimulus) {}
  virtual ~RandomHost() = default;

  /// The straps, before RESET rises.
  virtual void strap() {}
  /// Pins high from here on that keep the chip from the DPRAM.
  virtual void hold_through_reset() {}
  virtual void take() = 0;
  virtual void give() = 0;
  virtual void write(int address, int value) = 0;
  virtual void read(int address) = 0;
  /// ... and its CRC, which may be wrong.
  virtual void block(int address, int crc_address, const bus::Bytes& bytes) = 0;
  /// Pins in an order that nothing has.
  virtual void rude() = 0;
  /// Accesses of which each breaks a rule of its own; the port is at rest before and after.
  virtual void break_rules() {}
  /// Traffic that only this port has; false, without a number drawn: it has none.
  virtual bool own_traffic() { return false; }
  /// Whether whole initialisations and data exchange take no longer than a case.
  virtual bool is_quick() const { return true; }
  /// Nothing for so many cycles.
  void wait(int cycles);

 protected:
  void pin(Pin pin, int value, Tick delay);

  Random& random_;
  Stimulus& stimulus_;
};

std::unique_ptr<RandomHost> make_random_parallel(Random& random, Stimulus& stimulus);
/// Of the DSDPV1-RSU.
std::unique_ptr<RandomHost> make_random_spi(Random& random, Stimulus& stimulus);
std::unique_ptr<RandomHost> make_random_uart(Random& random, Stimulus& stimulus);

}  // namespace dsdpv1::cosim

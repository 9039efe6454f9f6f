#pragma once
// What the user of a random case does at a host port: the DPRAM taken and given, cells and blocks read and written, and
// things that nobody should do. One class for each port: parallel, SPI and UART.
#include <memory>

#include "cosim/random/random_setup.hpp"
#include "kinds/dsdpv1/random/access_parts.hpp"
#include "model/dsdpv1/config.hpp"

namespace dsdpv1::cosim {

class RandomHost {
 public:
  RandomHost(Random& random, Stimulus& stimulus) : random_(random), stimulus_(stimulus) {}
  virtual ~RandomHost() = default;

  /// From now on nothing goes wrong at the port, and the user does what is meant.
  void careful(bool careful) { careful_ = careful; }
  /// Something goes wrong, once in `n` times; never while careful.
  bool mishap(int n) { return !careful_ && random_.one_in(n); }

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
  /// The port's first edge of something, be it proper or not, during a part of an access of the chip that comes within
  /// so many ticks; the port is at rest behind it.
  virtual void edge(AccessPart part, Tick within) = 0;
  /// What the user has just done is left as soon as the chip has it: nobody waits for its reply.
  virtual void hurry() {}
  /// About how many requests of a master pass while the user does something.
  virtual int slowness() const { return 1; }
  /// Whether whole initialisations and data exchange take no longer than a case.
  virtual bool is_quick() const { return true; }
  /// Nothing for so many cycles.
  void wait(int cycles);

 protected:
  /// All actions of the user go through here.
  void push(Action action);
  void pin(Pin pin, int value, Tick delay);
  /// The next action is aimed, in the place of its delay.
  void aim(AccessPart part, Tick within);

  Random& random_;
  Stimulus& stimulus_;

 private:
  bool careful_ = false;
  AccessPart aimed_at_ = AccessPart::kNone;
  Tick within_ = 0;
};

std::unique_ptr<RandomHost> make_random_parallel(Random& random, Stimulus& stimulus, Part part);
/// Of the DSDPV1-RSU.
std::unique_ptr<RandomHost> make_random_spi(Random& random, Stimulus& stimulus);
std::unique_ptr<RandomHost> make_random_uart(Random& random, Stimulus& stimulus);

}  // namespace dsdpv1::cosim

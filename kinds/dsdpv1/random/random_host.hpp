#pragma once
// The user of a random case at a host port: takes and releases the DPRAM, reads and writes cells and blocks, and breaks
// rules. One class per port: parallel, SPI and UART.
#include <memory>

#include "cosim/random/random_setup.hpp"
#include "kinds/dsdpv1/random/access_parts.hpp"
#include "model/dsdpv1/config.hpp"

namespace dsdpv1::cosim {

class RandomHost {
 public:
  RandomHost(Random& random, Stimulus& stimulus) : random_(random), stimulus_(stimulus) {}
  virtual ~RandomHost() = default;

  /// From now on no mishap occurs at the port, and the user acts as intended.
  void careful(bool careful) { careful_ = careful; }
  /// True once in `n` times, for a mishap; never while careful.
  bool mishap(int n) { return !careful_ && random_.one_in(n); }

  /// The straps, before RESET rises.
  virtual void strap() {}
  /// Pins that are high from here on and keep the chip from the DPRAM.
  virtual void hold_through_reset() {}
  virtual void take() = 0;
  virtual void give() = 0;
  virtual void write(int address, int value) = 0;
  virtual void read(int address) = 0;
  /// ... and its CRC, which may be wrong.
  virtual void block(int address, int crc_address, const bus::Bytes& bytes) = 0;
  /// Pins in an invalid order.
  virtual void rude() = 0;
  /// Accesses that each break one rule; the port is idle before and after.
  virtual void break_rules() {}
  /// Traffic that only this port has; returns false, without drawing a number, if it has none.
  virtual bool own_traffic() { return false; }
  /// The first edge of an action, valid or not, during a part of a chip access that comes within so many ticks; the
  /// port is idle afterwards.
  virtual void edge(AccessPart part, Tick within) = 0;
  /// Ends the user's last action as soon as the chip has received it, without waiting for a reply.
  virtual void hurry() {}
  /// Approximate number of master requests during one action of the user.
  virtual int slowness() const { return 1; }
  /// True if whole initialisations and data exchange take no longer than a case.
  virtual bool is_quick() const { return true; }
  /// Waits so many cycles.
  void wait(int cycles);

 protected:
  /// All actions of the user go through here.
  void push(Action action);
  void pin(Pin pin, int value, Tick delay);
  /// The next action waits for a part of an access instead of its delay.
  void aim(AccessPart part, Tick within);

  Random& random_;
  Stimulus& stimulus_;

 private:
  bool careful_ = false;
  AccessPart aimed_at_ = AccessPart::kNone;
  Tick within_ = 0;
};

std::unique_ptr<RandomHost> make_random_parallel(Random& random, Stimulus& stimulus, Part part);
/// For the DSDPV1-RSU.
std::unique_ptr<RandomHost> make_random_spi(Random& random, Stimulus& stimulus);
std::unique_ptr<RandomHost> make_random_uart(Random& random, Stimulus& stimulus);

}  // namespace dsdpv1::cosim

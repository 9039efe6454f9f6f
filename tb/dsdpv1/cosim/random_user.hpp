#pragma once
// The user of a random case: blocks right and wrong, verdicts, reads, and things that nobody should do.
#include "tb/dsdpv1/cosim/random_setup.hpp"

namespace dsdpv1::cosim {

class RandomUser {
 public:
  RandomUser(Random& random, const Setup& setup, Stimulus& stimulus)
      : random_(random), setup_(setup), stimulus_(stimulus) {}

  Setup any_setup();
  /// The block of the present setup, mostly right.
  void initialise();
  void inputs();
  void diagnosis();
  void verdict(bool prm, bool cfg, bool good);
  /// Reads a block that the chip has written and clears its flag.
  void fetch();
  void enable_dpv1(int value);
  /// To the last request on SAP 51 (channel 0), 48 or 47; mostly right.
  void acyclic_answer(int channel);
  void take();
  void give();
  /// R_REQ, R_STA, both or none high from here on.
  void hold_through_reset();
  /// Nothing for so many cycles.
  void wait(int cycles);
  void anything();

 private:
  void pin(Pin pin, int value, int delay);
  void write(int address, int value);
  void read(int address);
  void block(int address, int crc_address, const bus::Bytes& bytes);
  void command(int value);
  void poke();
  void rude();
  void long_hold();
  void dpv1();
  Action access(Verb verb);
  Tick small_delay();

  Random& random_;
  const Setup& setup_;
  Stimulus& stimulus_;
};

}  // namespace dsdpv1::cosim

#pragma once
// The user of a random case: valid and invalid blocks, verdicts, reads, and actions that break rules.
#include "kinds/dsdpv1/random/random_host.hpp"

namespace dsdpv1::cosim {

class RandomUser {
 public:
  RandomUser(Random& random, const Setup& setup, RandomHost& host) : random_(random), setup_(setup), host_(host) {}

  Setup any_setup();
  /// The block of the present setup, usually valid.
  void initialise();
  /// ... with one byte out of range (D7, D11, D12).
  void initialise_wrong();
  void inputs();
  void diagnosis();
  void verdict(bool prm, bool cfg, bool good);
  /// Reads a block written by the chip and clears its flag.
  void fetch();
  void enable_dpv1(int value);
  /// Answers the last request on SAP 51 (channel 0), 48 or 47; usually right.
  void acyclic_answer(int channel);
  void anything();

 private:
  bus::Bytes init_block() const;
  void hand_over_init(const bus::Bytes& bytes);
  void command(int value);
  void poke();
  void long_hold();
  void dpv1();

  Random& random_;
  const Setup& setup_;
  RandomHost& host_;
};

}  // namespace dsdpv1::cosim

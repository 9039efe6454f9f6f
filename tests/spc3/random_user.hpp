#pragma once
// A random user and random masters, and what holds whatever they do: events and interrupt, the buffers' machines, the
// pointers. Everything follows from the seed.
#include <array>
#include <random>

#include "tests/spc3/bench.hpp"

namespace dsdpv1::spc3_test {

/// Rules that need what the user wrote before: the mask, the end of an interrupt, the pointers.
class Rules {
 public:
  explicit Rules(const Bench& bench, const spc3::Config& config) : bench_(bench), config_(config) {}
  void reset();
  /// Before the user's write: an address as the chip decodes it.
  void writes(Address address, std::uint8_t value);
  /// The pointers are the user's new ones.
  void take_pointers() { pointers_ = pointers(); }
  void check() const;

  static constexpr std::array<Address, 13> kPointers = {
      regs::kOrgDoutPointer,    regs::kOrgDoutPointer + 1, regs::kOrgDoutPointer + 2, regs::kOrgDinPointer,
      regs::kOrgDinPointer + 1, regs::kOrgDinPointer + 2,  regs::kOrgDiagPointer,     regs::kOrgDiagPointer + 1,
      regs::kOrgAuxPointer,     regs::kOrgAuxPointer + 1,  regs::kOrgSsaPointer,      regs::kOrgPrmPointer,
      regs::kOrgCfgPointer};

 private:
  const spc3::Chip& chip() const { return bench_.twins.chip(); }
  unsigned word(Address low) const;
  bool interrupts() const;
  std::array<std::uint8_t, kPointers.size() + 1> pointers() const;
  void check_interrupt() const;
  void check_buffers() const;

  const Bench& bench_;
  const spc3::Config& config_;
  std::uint16_t imr_ = 0xFFFF, mode0_ = 0;
  Cycle inactive_until_ = 0;  // of X/INT
  std::array<std::uint8_t, kPointers.size() + 1> pointers_{};
};

class RandomUser : private bus::Agent {
 public:
  RandomUser(unsigned seed, Engines engines);
  /// Stops at the first failure.
  void play(int acts);
  int accesses() const { return accesses_; }
  bool has_exchanged() const { return exchanged_; }

 private:
  // Accesses and saved states in the middle of telegrams.
  Tick next() const override { return left_ > 0 ? at_ : bus::kNever; }
  void run(Tick now) override;
  void plan();

  unsigned below(unsigned end) { return static_cast<unsigned>(random_() % end); }
  std::uint8_t byte() { return static_cast<std::uint8_t>(below(256)); }
  Bytes bytes(unsigned most);
  std::uint8_t load(unsigned address);
  void store(unsigned address, std::uint8_t value);

  void begin();
  void act();
  void telegram();
  void telegram_for_others();
  void access();
  void write();
  void exchange_pointers();
  void reset();

  std::mt19937 random_;
  const spc3::Config config_;
  const bool twin_;
  Bench bench_;
  Rules rules_;
  int accesses_ = 0;
  bool exchanged_ = false, in_reset_ = true;
  Tick at_ = 0;
  int left_ = 0;
};

}  // namespace dsdpv1::spc3_test

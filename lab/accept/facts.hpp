#pragma once
// What happens in a run of accept, by names: codes of the chip's events, and these:
//
//   in data exchange     the slave enters data exchange
//   new outputs          a Data_Exchange with other outputs than the one before
//   C1 data, C1 error    a positive and a negative answer of the user; C2 data, C2 error
//   newer block          Set_Prm or Chk_Cfg comes before the user's verdict on the one before
//   spoilt               the user reads a wrong bit
//   interrupt            its interrupt pin falls
//   interrupt waiting    ... while the user waits for the memory that it shares with the chip
//   interrupt inside     ... in a hold of that memory
//   interrupt released   ... within 2 us after a hold
//   request in interrupt the user asks for the memory while the pin is low
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/time.hpp"
#include "tb/bench/observer.hpp"

namespace dsdpv1::tb::accept {

struct Violated {
  Tick at = 0;
  std::string code;
};

class Facts : public Observer {
 public:
  /// `scenario` must outlive it. `device`: the address of the slave.
  Facts(const scenario::Scenario& scenario, std::uint8_t device);

  /// From `from` on, before `to`.
  std::uint64_t count(const std::string& fact, Tick from, Tick to) const;
  const std::vector<Violated>& violations() const { return violations_; }
  /// The start of the script, whose first action does nothing but say so.
  std::optional<Tick> begun() const { return begun_; }
  /// The address that the firmware has given to the chip.
  std::optional<unsigned> address() const { return address_; }

  void begins(std::size_t slave, const ChipView& chip) override;
  void pin(std::size_t slave, Tick at, PinNumber pin, Level level) override;
  void event(std::size_t slave, const profibus::Event& event) override;
  void telegram(const HeardTelegram& telegram) override;
  void action(std::size_t slave, Tick at, const std::string& words) override;
  void violated(const std::string& slave, const checks::Violation& violation, const char* kind) override;
  void flag(const bus::Flag& flag) override;
  void user_failed(std::size_t slave, Tick at, const std::string& why, const std::string& registers) override;
  void acts(const scenario::Action& action, Tick now) override;

 private:
  void add(const std::string& fact, Tick at) { facts_[fact].push_back(at); }
  void interrupted(Tick at);
  void holds(Tick at, bool holds);
  void judged(const profibus::Event& event);
  void answered(const profibus::Event& event);

  const scenario::Scenario& scenario_;
  const ChipKind& kind_;
  const std::uint8_t device_;
  const PinNumber interrupt_;
  const PinMask hold_pins_;  ///< of the user: one of them is high while it waits, all in a hold
  PinMask high_ = 0;         ///< of them
  bool interrupts_ = false, holds_ = false;
  Tick released_ = -bus::kTicksPerSecond;
  std::map<std::string, std::vector<Tick>> facts_;
  std::set<std::string> with_user_;  ///< "PRM", "CFG": blocks that it has to judge
  std::vector<Violated> violations_;
  bus::Bytes outputs_;
  std::optional<Tick> begun_;
  std::optional<unsigned> address_;
};

}  // namespace dsdpv1::tb::accept

#pragma once
// The checks of a run: one set per slave, the violations that fail the scenario, and the data for the report.
#include <memory>
#include <string>
#include <vector>

#include "tb/bench/observer.hpp"
#include "tb/bench/record.hpp"
#include "tb/chip/checks/chip_checks.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

class CheckWatch : public Observer {
 public:
  /// `scenario` and `observers`, which receive violations, must outlive it. Throws InputError if an expectation, or the
  /// condition of an action, refers to a check that is not made.
  CheckWatch(const scenario::Scenario& scenario, ChecksMode mode, const Observers& observers);
  CheckWatch(const CheckWatch&) = delete;
  CheckWatch& operator=(const CheckWatch&) = delete;

  bool on() const { return on_; }
  /// The slave's pins that must be watched, none when off.
  PinMask pins(const scenario::Slave& slave) const;

  /// Slaves are numbered in the order in which they are added. Does nothing when off.
  void add(const scenario::Slave& slave, ChipView& chip);
  void pin(std::size_t slave, Tick at, PinNumber pin, Level level) override {
    if (checks::ChipChecks* own = of(slave)) own->pin(at, pin, level);
  }
  void edges(std::size_t slave, const PinEdge* first, const PinEdge* last) override {
    if (checks::ChipChecks* own = of(slave)) own->pins(first, last);
  }
  void read(std::size_t slave, Tick sample) override {
    if (checks::ChipChecks* own = of(slave)) own->read(sample);
  }
  void looked(std::size_t slave, PinNumber pin, Tick at) override {
    if (checks::ChipChecks* own = of(slave)) own->looked(pin, at);
  }
  void accessed(std::size_t slave, Tick at, std::uint16_t address, std::uint8_t value, bool write) override {
    if (checks::ChipChecks* own = of(slave)) own->unseen_access(at, address, value, write);
  }
  void event(std::size_t slave, const profibus::Event& event) override {
    if (checks::ChipChecks* own = of(slave)) own->event(event);
  }
  void telegram(const HeardTelegram& telegram) override;
  void finish(Tick end);

  ChecksMode mode() const { return mode_; }
  /// Number of checks that the scenario disables.
  std::uint64_t left_out() const;
  /// Violations that fail the run.
  std::uint64_t failures() const { return failures_; }
  std::vector<CheckResult> results() const;

 private:
  struct Slave {
    std::size_t number = 0;
    std::string name;
    ChipView* chip = nullptr;
    const checks::RuleTable* rules = nullptr;
    std::unique_ptr<checks::ChipChecks> checks;  ///< null: its kind has none
    std::vector<checks::Violation> listed;
    std::vector<std::uint64_t> allowed;  ///< by check
    std::vector<std::size_t> listed_of;
  };
  /// Null without checks.
  checks::ChipChecks* of(std::size_t slave) { return on() ? slaves_[slave]->checks.get() : nullptr; }
  void keep(Slave& slave, checks::Violation violation);

  const scenario::Scenario& scenario_;
  ChecksMode mode_;
  const Observers& observers_;
  bool on_;
  std::vector<std::unique_ptr<Slave>> slaves_;
  std::uint64_t failures_ = 0;
};

}  // namespace dsdpv1::tb

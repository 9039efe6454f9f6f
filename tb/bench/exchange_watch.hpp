#pragma once
// What is expected of each slave that a master of class 1 has, without a word in the scenario: it comes to data
// exchange, is in it at the end, and does not leave it but for the script.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tb/bench/observer.hpp"
#include "tb/bench/record.hpp"
#include "tb/bench/stations.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb {

class ExchangeWatch : public Observer {
 public:
  /// Both must outlive it. `stations` need not be complete yet.
  ExchangeWatch(const scenario::Scenario& scenario, const Stations& stations);

  void event(std::size_t slave, const profibus::Event& event) override;
  void master_state(Tick now, const std::string& master, const std::string& member, const std::string& state) override;
  void acts(const scenario::Action& action, Tick now) override;

  /// At the end of a run; none where the scenario wants none.
  std::vector<ExpectationResult> finish(const std::vector<SlaveResult>& slaves) const;
  /// See SlaveResult::waits_for.
  std::string waits_for(const SlaveResult& slave) const;

 private:
  /// A slave in the list of a master.
  struct Entry {
    std::string master, slave;
    std::string member;  ///< what the master calls it
    int line = 0;
    bool may_leave = false;          ///< the scenario says so
    bool in = false;                 ///< data exchange, as its master has it
    bool disturbed = false;          ///< by the script since it came to data exchange: it may leave it
    bool kept_away = false;          ///< by the script, until the script ends that
    std::optional<Tick> since = {};  ///< when it came to data exchange last
    std::uint64_t left = 0;          ///< how often it left without the script
    Tick first_left = 0;
    std::string why = {};  ///< the first time
  };
  void add(const scenario::Master& master, const scenario::MasterSlave& listed);
  /// Of each step to data exchange what stands in the way of it, as the chip has said; empty when nothing does.
  using Steps = std::array<std::optional<profibus::Event>, 4>;
  ExpectationResult judged(const Entry& entry, const SlaveResult& slave) const;
  std::size_t index_of(const std::string& slave) const;

  const scenario::Scenario& scenario_;
  const Stations& stations_;
  std::vector<Entry> entries_;
  std::vector<Steps> steps_;                          ///< by slave
  std::vector<std::optional<profibus::Event>> ends_;  ///< by slave: the last event that ends data exchange
};

}  // namespace dsdpv1::tb

#pragma once
// Expectations for each slave of a class 1 master that apply without being in the scenario: it reaches data exchange,
// is in it at the end, and leaves it only because of the script.
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

  /// At the end of a run; empty if the scenario disables them.
  std::vector<ExpectationResult> finish(const std::vector<SlaveResult>& slaves) const;
  /// See SlaveResult::waits_for.
  std::string waits_for(const SlaveResult& slave) const;

 private:
  /// A slave in the list of a master.
  struct Entry {
    std::string master, slave;
    std::string member;  ///< the master's name for it
    int line = 0;
    bool may_leave = false;          ///< the scenario allows it
    bool in = false;                 ///< data exchange, according to its master
    bool disturbed = false;          ///< by the script since it reached data exchange: it may leave it
    bool kept_away = false;          ///< by the script, until the script restores it
    Tick acted = -1;                 ///< when the script did
    std::optional<Tick> since = {};  ///< when it last reached data exchange
    std::uint64_t left = 0;          ///< how often it left without the script
    Tick first_left = 0;
    std::string why = {};  ///< the first time
  };
  void add(const scenario::Master& master, const scenario::MasterSlave& listed);
  /// For each step to data exchange, the chip's event that blocks it; empty if none does.
  using Steps = std::array<std::optional<profibus::Event>, 4>;
  ExpectationResult judged(const Entry& entry, const SlaveResult& slave) const;

  const scenario::Scenario& scenario_;
  const Stations& stations_;
  std::vector<Entry> entries_;
  std::vector<Steps> steps_;                          ///< by slave
  std::vector<std::optional<profibus::Event>> ends_;  ///< by slave: the last event that ends data exchange
  std::vector<std::optional<Tick>> entered_;          ///< by slave: when it has entered data exchange; absent: not told
};

}  // namespace dsdpv1::tb

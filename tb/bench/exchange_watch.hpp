#pragma once
// Expectations for each slave of a class 1 master that apply without being in the scenario: it reaches data exchange,
// is in it at the end, and leaves it only because of the script. The same for each slave that a host has parameterised,
// as long as the host continues.
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
  /// Both must outlive it. `stations` need not be complete yet. `host`: a master outside the scenario may have the
  /// slaves that are in no list.
  ExchangeWatch(const scenario::Scenario& scenario, const Stations& stations, bool host);

  void event(std::size_t slave, const profibus::Event& event) override;
  void master_state(Tick now, const std::string& master, const std::string& member, const std::string& state) override;
  void acts(const scenario::Action& action, Tick now) override;
  void telegram(const HeardTelegram& heard) override;
  /// The slaves' states do not count until the next one parameterises them.
  void host_gone();

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
    std::string why = {};                       ///< the first time
    bool of_host = false;                       ///< the others are of a host only
    bool asked = false;                         ///< the host has sent Set_Prm
    bool refused = false;                       ///< the last Set_Prm or Chk_Cfg
    bool let_go = false;                        ///< the host has hung up or released it
    std::optional<profibus::Event> ended = {};  ///< the host may have ended, too: nothing has come from it since
  };
  void add(const scenario::Master& master, const scenario::MasterSlave& listed);
  void add_of_host(const scenario::Slave& slave);
  void enter(Entry& entry, Tick now) const;
  static void event_of_host(Entry& entry, const profibus::Event& event);
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

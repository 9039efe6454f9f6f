#pragma once
// A random case under construction: it brings the slave up, usually in the right order, and then plays one of its
// themes.
#include <memory>

#include "cosim/random/random_master.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/random/random_host.hpp"
#include "kinds/dsdpv1/random/random_user.hpp"
#include "model/profibus/dp_state.hpp"

namespace dsdpv1::cosim {

class RandomCase {
 public:
  RandomCase(std::uint64_t seed, const tb::Dsdpv1Settings& chip);

  Stimulus make();

 private:
  /// The theme of an episode: the required state of the slave, the line's rate, and the events. One of weight 0 leads a
  /// case: everything before it is right.
  struct Theme {
    int weight;
    void (RandomCase::*prepare)();
    void (RandomMaster::*find_rate)();
    void (RandomCase::*play)();
  };
  static const Theme kThemes[], kLeading[];
  const Theme& any_theme();

  void episode(const Theme& theme);
  Stimulus host_only();
  // the way up
  void power_on(bool sure = false);
  void come_up(const Theme& theme);
  void bring_up();
  void reach(profibus::DpState state);
  void reset();
  // states of the slave that themes require
  void as_it_is() {}
  void with_dpv1();
  void perhaps_with_dpv1();
  void judged_by_user();
  void with_sync_and_freeze();
  void without_address();
  void with_everything();
  void with_the_usual();
  void with_a_long_configuration();
  // themes
  void wild();
  void acyclic();
  void acyclic_timers();
  void hold_commands();
  void judgements();
  void initialisations();
  void services();
  void timeouts();
  void addresses();
  void slow_rates();
  void port();
  void edges();
  // themes that lead
  void single_bits();
  void long_timers();
  void late_answers();
  // parts of themes
  int steps();
  void step();
  void acyclic_step(int channel);
  void address_changes();
  void judging();
  void supersede();
  void hold_commands_seen();
  void hold_commands_unseen();
  void priority();
  void watchdog();
  void search_again();
  void edge_in(AccessPart part);
  void reset_in(AccessPart part);
  bool cause(AccessPart part);
  void reset_amid();
  void repetitions();
  void both_flags();
  void groups();
  void delivery_address();
  void request_of_class_2();

  void sync() { stimulus_.push_back({}); }
  void careful(bool careful) {
    master_.careful(careful);
    host_->careful(careful);
  }
  void verdict(bool prm, bool cfg);
  void push_reset(AccessPart part = AccessPart::kNone, Tick within = 0);

  const std::uint64_t leading_;  ///< number of the theme that leads, from 1; 0: any theme does
  Random random_;
  Setup setup_;
  Stimulus stimulus_;
  RandomMaster master_;
  std::unique_ptr<RandomHost> host_;
  RandomUser user_;
  const Theme* theme_ = nullptr;
};

}  // namespace dsdpv1::cosim

#include "tb/cosim/random_stimulus.hpp"

#include <algorithm>
#include <random>

#include "tb/cosim/random_master.hpp"
#include "tb/cosim/random_user.hpp"

namespace cosim {
namespace {

class Case {
 public:
  explicit Case(std::uint64_t seed) : random_(seed), master_(random_, setup_, stimulus_), user_(random_, setup_, stimulus_) {}

  Stimulus make() {
    power_on();
    for (int i = random_.between(1, 3); i > 0; --i) episode();
    return std::move(stimulus_);
  }

 private:
  void sync() { stimulus_.push_back({}); }

  void power_on() {
    Action reset;
    reset.verb = Verb::kReset;
    reset.low = random_.between(1, 20'000);
    stimulus_.push_back(reset);
    sync();
    // Sometimes the user comes before the chip is ready (H6).
    user_.wait(random_.one_in(4) ? random_.between(0, 4200) : 4200);
  }

  /// An initialisation, a baud rate, and then anything.
  void episode() {
    setup_ = user_.any_setup();
    master_.forget_series();
    user_.initialise();
    sync();
    if (random_.one_in(12)) user_.initialise();
    user_.wait(200);
    sync();
    master_.choose_rate();
    if (!random_.one_in(8)) bring_up();
    for (int i = steps(); i > 0; --i) step();
    sync();
  }
  int steps() {
    if (setup_.rate >= 6) return random_.between(1, 3);
    return setup_.rate < 3 ? random_.between(20, 80) : random_.between(4, 20);
  }

  /// The usual way to data exchange, with the user's verdicts where the modes ask for them.
  void bring_up() {
    if (random_.one_in(2)) master_.slave_diag();
    master_.set_prm(true);
    sync();
    user_.wait(300);
    if (setup_.prm_mode == 2) user_.verdict(true, false, !random_.one_in(8));
    sync();
    master_.check_cfg(true);
    sync();
    user_.wait(300);
    if (setup_.cfg_mode == 2) user_.verdict(false, true, !random_.one_in(8));
    sync();
    if (random_.one_in(2)) master_.slave_diag();
    for (int i = random_.between(0, 3); i > 0; --i) master_.data_exchange();
  }

  void step() {
    const int what = random_.below(200);
    if (what < 110) return master_.anything();
    if (what < 180) return user_.anything();
    if (what < 188) return sync();
    if (what < 192) return bring_up();
    if (what < 195) return master_.silence();
    if (what < 197) return search_again();
    if (what < 198) return reset();
    return user_.initialise();
  }

  /// Silence until BAUD_CONTROL has run out, then another rate (S1); the DP state stays.
  void search_again() {
    sync();
    master_.wait_baud_control();
    master_.choose_rate();
  }
  void reset() {
    sync();
    user_.give();
    power_on();
    setup_ = user_.any_setup();
    user_.initialise();
    user_.wait(200);
    sync();
    master_.choose_rate();
  }

  Random random_;
  Setup setup_;
  Stimulus stimulus_;
  RandomMaster master_;
  RandomUser user_;
};

}  // namespace

Stimulus random_stimulus(std::uint64_t seed) { return Case(seed).make(); }

}  // namespace cosim

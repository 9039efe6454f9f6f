#include "tb/dsdpv1/cosim/random_stimulus.hpp"

#include <algorithm>
#include <iterator>
#include <random>

#include "tb/dsdpv1/cosim/random_host.hpp"
#include "tb/dsdpv1/cosim/random_master.hpp"
#include "tb/dsdpv1/cosim/random_user.hpp"

namespace dsdpv1::cosim {
namespace {

class Case {
 public:
  Case(std::uint64_t seed, std::unique_ptr<RandomHost> (*make_host)(Random&, Stimulus&), const dsdpv1::Config& config)
      : random_(seed),
        master_(random_, setup_, stimulus_, config),
        host_(make_host(random_, stimulus_)),
        user_(random_, setup_, *host_) {}

  Stimulus make() {
    power_on();
    if (!host_->is_quick()) return host_only();
    for (int i = random_.between(1, 3); i > 0; --i) episode();
    sync();
    host_->give();
    host_->break_rules();
    if (random_.one_in(2)) reset_amid();
    return std::move(stimulus_);
  }

 private:
  void sync() { stimulus_.push_back({}); }

  /// Where a telegram of the host lasts as long as thousands on the line.
  Stimulus host_only() {
    for (int i = random_.between(2, 5); i > 0; --i) user_.anything();
    return std::move(stimulus_);
  }

  void power_on() {
    Action reset;
    reset.verb = Verb::kReset;
    reset.low = random_.between(1, 20'000);
    host_->strap();
    const bool held = random_.one_in(6);
    if (held) host_->hold_through_reset();
    stimulus_.push_back(reset);
    sync();
    if (held) host_->wait(random_.between(0, 4200));
    if (held) host_->give();
    // Sometimes the user comes before the chip is ready (H6).
    host_->wait(random_.one_in(4) ? random_.between(0, 4200) : 4200);
  }

  /// An initialisation, a baud rate, and then anything.
  void episode() {
    setup_ = user_.any_setup();
    const bool dpv1 = random_.one_in(2);
    if (dpv1) prepare_dpv1();
    master_.forget_series();
    if (dpv1) user_.enable_dpv1(0x1D);  // before the initialisation (D17)
    user_.initialise();
    sync();
    if (random_.one_in(12)) user_.initialise();
    host_->wait(200);
    sync();
    if (dpv1)
      master_.fastest_rate();
    else
      master_.choose_rate();
    for (int i = random_.below(4); i > 0; --i) random_.one_in(3) ? master_.set_slave_address() : master_.anything();
    if (random_.one_in(5)) address_changes();
    if (!random_.one_in(8)) bring_up();
    if (dpv1) acyclic();
    for (int i = steps(); i > 0; --i) step();
    sync();
  }
  /// About as many cycles at every rate; most of them where most can happen.
  int steps() {
    constexpr int kMost[] = {120, 50, 20, 10, 4};
    const int most = setup_.rate < static_cast<int>(std::size(kMost)) ? kMost[setup_.rate] : 3;
    return random_.between(most / 3, most);
  }

  /// The usual way to data exchange, with the user's verdicts where the modes ask for them.
  void bring_up() {
    if (random_.one_in(2)) master_.slave_diag();
    master_.careful(!random_.one_in(4));
    const bool held = random_.one_in(4);  // both blocks wait for the user to let go of the DPRAM
    if (held) host_->take();
    sync();
    master_.set_prm(true);
    sync();
    if (!held) host_->wait(300);
    if (setup_.prm_mode == 2) user_.verdict(true, false, !random_.one_in(8));
    sync();
    master_.check_cfg(true);
    sync();
    if (held) host_->give();
    host_->wait(300);
    if (setup_.cfg_mode == 2) user_.verdict(false, true, !random_.one_in(8));
    sync();
    if (random_.one_in(2)) master_.slave_diag();
    for (int i = random_.between(0, 3); i > 0; --i) master_.data_exchange();
    master_.careful(false);
  }

  void step() {
    const int what = random_.below(200);
    if (what < 90) return master_.anything();
    if (what < 146) return user_.anything();
    if (what < 152) return sync();
    if (what < 164) return hold_commands();
    if (what < 170) return priority();
    if (what < 182) return judging();
    if (what < 192) return bring_up();
    if (what < 193) return master_.silence();
    if (what < 194) return watchdog();
    if (what < 196) return random_.one_in(3) ? search_again() : reset();
    return user_.initialise();
  }

  void prepare_dpv1() {
    setup_.dpv1 = true;
    setup_.prm_mode = 0;
    setup_.max_prm = 237;
  }
  /// Requests of both classes and the user's answers, in an order that is mostly the right one (V1 to V14).
  void acyclic() {
    master_.careful(true);
    for (int i = random_.between(0, 3); i > 0; --i) {
      master_.initiate();
      for (const int channel : {1, 2})
        if (!random_.one_in(6)) master_.acyclic_poll(channel);
    }
    for (int i = random_.between(10, 40); i > 0; --i) acyclic_step(random_.below(3));
    if (random_.one_in(4)) acyclic_timer();
    master_.careful(false);
  }
  void acyclic_step(int channel) {
    master_.careful(!random_.one_in(16));
    master_.acyclic_request(channel);
    if (random_.one_in(3)) master_.acyclic_request(random_.below(3));
    if (random_.one_in(4)) master_.acyclic_poll(channel);
    sync();
    host_->wait(random_.between(100, 400));
    if (random_.one_in(12)) channel = random_.below(3);
    if (!random_.one_in(8)) user_.acyclic_answer(channel);
    host_->wait(random_.between(50, 400));
    if (random_.one_in(3)) user_.acyclic_answer(random_.below(3));
    sync();
    master_.acyclic_poll(channel);
    if (random_.one_in(3)) master_.acyclic_poll(random_.below(3));
    if (random_.one_in(5)) master_.data_exchange();
    if (random_.one_in(10)) master_.initiate();
    if (random_.one_in(20)) master_.set_prm(!random_.one_in(3));
    if (random_.one_in(10)) bring_up();
  }
  /// F, I or U run out (V3, V12): Send_Timeout is 10 ms.
  void acyclic_timer() {
    const int channel = random_.between(1, 2);
    constexpr int kWaits[] = {5, 10, 10, 20, 20, 30};
    if (random_.one_in(2)) master_.acyclic_request(channel);
    master_.wait_timer(random_.pick(kWaits));
    master_.acyclic_poll(channel);
    master_.acyclic_poll(channel);
  }
  /// One after the other: the first may lock the address (S5).
  void address_changes() {
    master_.careful(true);
    for (int i = random_.between(2, 3); i > 0; --i) master_.set_slave_address();
    master_.slave_diag();
    master_.careful(false);
  }
  /// Parameters or a configuration that may be wrong, in the state in which they are looked at, and what the diagnosis
  /// says (S6, D8).
  void judging() {
    const bool prm = random_.one_in(2);
    sync();
    master_.careful(true);
    master_.set_prm(!prm);
    host_->wait(300);
    sync();
    if (setup_.prm_mode == 2) user_.verdict(true, false, true);
    master_.check_cfg(prm);
    sync();
    master_.slave_diag();
    master_.careful(false);
  }
  /// Sync, Freeze and their ends, with new data on both sides in between (S4).
  void hold_commands() {
    if (random_.one_in(2)) bring_up();
    master_.careful(!random_.one_in(4));
    if (random_.one_in(4))
      hold_commands_unseen();
    else
      hold_commands_seen();
    master_.careful(false);
  }
  void hold_commands_seen() {
    for (int i = random_.between(2, 4); i > 0; --i) {
      master_.global_control();
      user_.inputs();
      master_.data_exchange();
      sync();
      host_->wait(150);
      sync();
      master_.data_exchange();
      if (random_.one_in(3)) master_.read_service();
    }
  }
  /// The same while the user keeps the chip from the DPRAM: what he gets in the end is what Sync has let through.
  void hold_commands_unseen() {
    sync();
    host_->take();
    host_->wait(20);
    sync();
    for (int i = random_.between(1, 3); i > 0; --i) {
      master_.global_control();
      master_.data_exchange();
    }
    sync();
    host_->give();
  }
  /// A diagnosis that changes the priority of the answers until the holder has read it (D9, S23).
  void priority() {
    sync();
    user_.diagnosis();
    host_->wait(150);
    sync();
    master_.data_exchange();
    master_.slave_diag();
    master_.data_exchange();
  }
  /// Parameters with a short watchdog, and no telegram until it has run out (S1).
  void watchdog() {
    sync();
    master_.set_prm_with_watchdog();
    master_.check_cfg(true);
    master_.wait_watchdog();
  }
  /// Silence until BAUD_CONTROL has run out, then another rate (S1); the DP state stays.
  void search_again() {
    sync();
    master_.data_exchange();
    master_.wait_baud_control();
    master_.choose_rate();
    master_.repeat_last();
  }
  void reset() {
    sync();
    host_->give();
    power_on();
    setup_ = user_.any_setup();
    user_.initialise();
    host_->wait(200);
    sync();
    master_.choose_rate();
  }

  /// RESET falls while telegrams, blocks of the user and accesses of the chip are under way (H6, P10).
  void reset_amid() {
    constexpr int kWhile = 300'000;  // ticks: a telegram at 12 Mbit/s, or a block
    sync();
    random_.one_in(3) ? master_.set_prm(true) : random_.one_in(2) ? master_.check_cfg(true) : master_.data_exchange();
    random_.one_in(2) ? user_.inputs() : user_.anything();
    Action reset;
    reset.verb = Verb::kReset;
    reset.delay = random_.below(kWhile);
    reset.low = random_.between(1, 20'000);
    stimulus_.push_back(reset);
    sync();
    host_->give();
    if (random_.one_in(2)) return host_->wait(4200);
    reset.delay = random_.below(4096 * static_cast<int>(profibus::kTicksPerCycle));  // in the start-up
    stimulus_.push_back(reset);
    sync();
    host_->wait(4200);
  }

  Random random_;
  Setup setup_;
  Stimulus stimulus_;
  RandomMaster master_;
  std::unique_ptr<RandomHost> host_;
  RandomUser user_;
};

}  // namespace

Stimulus random_stimulus(std::uint64_t seed, HostMode mode, const dsdpv1::Config& config) {
  const auto make = mode == HostMode::kSpi    ? make_random_spi
                    : mode == HostMode::kUart ? make_random_uart
                                              : make_random_parallel;
  return Case(seed, make, config).make();
}

}  // namespace dsdpv1::cosim

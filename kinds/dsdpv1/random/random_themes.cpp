// The themes of episodes in random cases.
#include "kinds/dsdpv1/random/random_case.hpp"

#include <algorithm>
#include <iterator>

namespace dsdpv1::cosim {
namespace {

using profibus::DpState;

constexpr Tick kCycle = profibus::kTicksPerCycle;

}  // namespace

// Themes that wait for milliseconds are rare, because cost grows with cycles.
const RandomCase::Theme RandomCase::kThemes[] = {
    {4, &RandomCase::as_it_is, &RandomMaster::choose_rate, &RandomCase::wild},
    {6, &RandomCase::with_dpv1, &RandomMaster::fastest_rate, &RandomCase::acyclic},
    {1, &RandomCase::with_dpv1, &RandomMaster::fastest_rate, &RandomCase::acyclic_timers},
    {3, &RandomCase::with_sync_and_freeze, &RandomMaster::choose_rate, &RandomCase::hold_commands},
    {4, &RandomCase::judged_by_user, &RandomMaster::fastest_rate, &RandomCase::judgements},
    {2, &RandomCase::as_it_is, &RandomMaster::fastest_rate, &RandomCase::initialisations},
    {4, &RandomCase::perhaps_with_dpv1, &RandomMaster::choose_rate, &RandomCase::services},
    {2, &RandomCase::judged_by_user, &RandomMaster::fastest_rate, &RandomCase::timeouts},
    {2, &RandomCase::without_address, &RandomMaster::choose_rate, &RandomCase::addresses},
    {1, &RandomCase::as_it_is, &RandomMaster::slow_rate, &RandomCase::slow_rates},
    {3, &RandomCase::as_it_is, &RandomMaster::fastest_rate, &RandomCase::port},
    {9, &RandomCase::with_everything, &RandomMaster::fastest_rate, &RandomCase::edges},
};

// The first cases of a campaign, by case_seed(): what one bit or cycle decides, and what takes long, so that also a
// short campaign meets each.
const RandomCase::Theme RandomCase::kLeading[] = {
    {0, &RandomCase::with_a_long_configuration, &RandomMaster::fastest_rate, &RandomCase::single_bits},
    {0, &RandomCase::with_the_usual, &RandomMaster::fastest_rate, &RandomCase::long_timers},
    {0, &RandomCase::with_a_long_configuration, &RandomMaster::fastest_rate, &RandomCase::single_bits},
    {0, &RandomCase::with_the_usual, &RandomMaster::rate_of_500k, &RandomCase::late_answers},
    {0, &RandomCase::with_a_long_configuration, &RandomMaster::fastest_rate, &RandomCase::single_bits},
    {0, &RandomCase::with_the_usual, &RandomMaster::rate_after_a_window, &RandomCase::as_it_is},
    {0, &RandomCase::with_a_long_configuration, &RandomMaster::fastest_rate, &RandomCase::single_bits},
};

const RandomCase::Theme& RandomCase::any_theme() {
  int all = 0;
  for (const Theme& each : kThemes) all += each.weight;
  int left = random_.below(all);
  const Theme* theme = kThemes;
  for (; left >= theme->weight; ++theme) left -= theme->weight;
  return *theme;
}

// --- states that they require ---------------------------------------------------------------------------------------

void RandomCase::with_dpv1() {
  setup_.dpv1 = true;
  setup_.prm_mode = 0;
  setup_.max_prm = 237;
}

void RandomCase::perhaps_with_dpv1() {
  if (random_.one_in(2)) with_dpv1();
}

void RandomCase::judged_by_user() {
  setup_.prm_mode = random_.one_in(2) ? 2 : random_.below(2);
  setup_.cfg_mode = random_.one_in(2) ? 2 : random_.below(2);
  if (random_.one_in(2)) setup_.max_prm = 237;
}

void RandomCase::with_sync_and_freeze() { setup_.command |= 0x06; }

void RandomCase::without_address() {
  setup_.command |= 0x01;
  if (random_.one_in(2)) setup_.address = 126;
}

/// Allows every item of the chip's accesses to be caused.
void RandomCase::with_everything() {
  with_dpv1();
  setup_.cfg_mode = 0;
  setup_.cfg = {0x31};
  setup_.inputs = setup_.outputs = 2;
}

/// No limit is in the way.
void RandomCase::with_the_usual() {
  setup_ = Setup();
  setup_.address = static_cast<std::uint8_t>(random_.between(1, 125));
  setup_.cfg = {0x31};
  setup_.dpv1 = true;
}

/// The flag of a configuration so long comes in INTR0's gap when both blocks wait for the user's release (P7).
void RandomCase::with_a_long_configuration() {
  with_the_usual();
  setup_.cfg.resize(static_cast<std::size_t>(random_.between(60, 115)), 0x00);
}

// --- everything ------------------------------------------------------------------------------------------------------

void RandomCase::wild() {
  for (int i = random_.below(4); i > 0; --i) random_.one_in(3) ? master_.set_slave_address() : master_.anything();
  if (random_.one_in(5)) address_changes();
  for (int i = steps(); i > 0; --i) step();
}

/// About the same number of cycles at every rate.
int RandomCase::steps() {
  constexpr int kMost[] = {60, 30, 15, 8, 4};
  const int most = setup_.rate < static_cast<int>(std::size(kMost)) ? kMost[setup_.rate] : 3;
  return random_.between(most / 3, most);
}

void RandomCase::step() {
  const int what = random_.below(200);
  if (what < 90) return master_.anything();
  if (what < 146) return random_.one_in(host_->slowness()) ? user_.anything() : master_.anything();
  if (what < 152) return sync();
  if (what < 164) return hold_commands_seen();
  if (what < 170) return priority();
  if (what < 182) return judging();
  if (what < 192) return bring_up();
  if (what < 193) return master_.silence();
  if (what < 194) return watchdog();
  if (what < 196) return random_.one_in(3) ? search_again() : reset();
  return user_.initialise();
}

/// A diagnosis that changes the priority of the answers until the holder has read it (D9, S23).
void RandomCase::priority() {
  sync();
  user_.diagnosis();
  host_->wait(150);
  sync();
  master_.data_exchange();
  master_.slave_diag();
  master_.data_exchange();
}

// --- DPV1 ------------------------------------------------------------------------------------------------------------

/// Requests of both classes and the user's answers, usually in the right order (V1 to V14).
void RandomCase::acyclic() {
  master_.careful(true);
  for (int i = random_.between(0, 3); i > 0; --i) {
    master_.initiate();
    for (const int channel : {1, 2})
      if (!random_.one_in(6)) master_.acyclic_poll(channel);
  }
  host_->careful(random_.one_in(2));
  for (int i = random_.below(4); i > 0; --i)
    user_.inputs();  // a UART reports parameters and configuration first (UA10)
  for (int i = random_.between(6, 20) / host_->slowness() + 5; i > 0; --i) acyclic_step(random_.below(3));
  careful(false);
}

void RandomCase::acyclic_step(int channel) {
  master_.careful(!random_.one_in(16));
  master_.acyclic_request(channel);
  if (random_.one_in(3)) master_.acyclic_request(random_.below(3));
  if (random_.one_in(4)) master_.acyclic_poll(channel);
  sync();
  host_->wait(random_.between(100, 400));
  if (random_.one_in(3)) user_.inputs();
  if (random_.one_in(12)) channel = random_.below(3);
  if (!random_.one_in(8)) user_.acyclic_answer(channel);
  host_->wait(random_.between(50, 400));
  if (random_.one_in(3)) user_.acyclic_answer(random_.below(3));
  sync();
  master_.acyclic_poll(channel);
  if (random_.one_in(3)) master_.acyclic_poll(random_.below(3));
  if (random_.one_in(5)) master_.data_exchange();
  if (random_.one_in(5)) master_.initiate();
  if (random_.one_in(20)) master_.set_prm(!random_.one_in(3));
  if (random_.one_in(10)) bring_up();
}

/// F, I or U run out (V3, V12), on both channels or one: Send_Timeout is 10 ms.
void RandomCase::acyclic_timers() {
  constexpr int kSteps = 3;  // Initiate, its poll, a request
  constexpr int kFewest[] = {10, 20, 10},
                kMost[] = {21, 22, 21};  // F and F again; I; U of one channel, then of the other
  master_.careful(true);
  const int depth = random_.one_in(2) ? kSteps : random_.between(1, kSteps - 1);
  for (const int channel : {1, 2}) {
    master_.initiate();
    if (depth > 1) master_.acyclic_poll(channel);
    if (depth > 2) master_.acyclic_request(channel);
  }
  const int wait = random_.one_in(3) ? kFewest[depth - 1] : kMost[depth - 1];
  master_.wait_timer(wait, depth == kSteps && !random_.one_in(4));
  for (int i = random_.between(1, 4); i > 0; --i) master_.acyclic_poll(random_.between(1, 2));
  master_.careful(false);
}

// --- Sync and Freeze -------------------------------------------------------------------------------------------------

/// Sync, Freeze and their ends, with new data on both sides between them (S4).
void RandomCase::hold_commands() {
  careful(!random_.one_in(4));
  for (int i = random_.between(1, 3); i > 0; --i) random_.one_in(4) ? hold_commands_unseen() : hold_commands_seen();
  for (int i = random_.between(5, 15); i > 0; --i) {
    master_.global_control();
    if (random_.one_in(2)) master_.data_exchange();
    if (random_.one_in(4 * host_->slowness())) user_.inputs();
  }
  careful(false);
}

void RandomCase::hold_commands_seen() {
  for (int i = random_.between(2, 4); i > 0; --i) {
    master_.global_control();
    if (random_.one_in(host_->slowness())) user_.inputs();
    master_.data_exchange();
    sync();
    host_->wait(150);
    sync();
    master_.data_exchange();
    if (random_.one_in(3)) master_.read_service();
  }
}

/// As above, while the user keeps the chip from the DPRAM: the final data are those that Sync passed.
void RandomCase::hold_commands_unseen() {
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

// --- parameters, configurations, verdicts ---------------------------------------------------------------------------

void RandomCase::judgements() {
  for (int i = random_.between(4, 12); i > 0; --i) random_.one_in(4) ? supersede() : judging();
}

/// Parameters or a configuration that may be wrong, in the state in which they are checked, and the resulting diagnosis
/// (S6, D8).
void RandomCase::judging() {
  const bool prm = random_.one_in(2);
  sync();
  master_.careful(true);
  master_.set_prm(!prm);
  host_->wait(300);
  sync();
  if (setup_.prm_mode == 2) user_.verdict(true, false, !prm || random_.one_in(2));
  sync();
  master_.check_cfg(prm);
  sync();
  if (setup_.cfg_mode == 2 && random_.one_in(2)) {
    host_->wait(300);
    user_.verdict(false, true, random_.one_in(2));
    sync();
  }
  master_.slave_diag();
  master_.careful(false);
}

/// A verdict on the user's present block, while a newer one waits for the release of the DPRAM (H7).
void RandomCase::supersede() {
  const bool prm = random_.one_in(2);
  careful(true);
  if (!prm) reach(DpState::kWaitCfg);
  sync();
  host_->take();
  sync();
  prm ? master_.set_prm(true) : master_.check_cfg(true);
  sync();
  user_.verdict(prm, !prm, true);
  sync();
  careful(false);
}

void RandomCase::initialisations() {
  host_->careful(!random_.one_in(4));
  for (int i = random_.between(3, 8); i > 0; --i) user_.initialise_wrong();
  if (random_.one_in(2)) user_.initialise();
  host_->careful(false);
}

// --- services, addresses, rates, silences ---------------------------------------------------------------------------

/// Each service in each state, with data or without, by the holder and by another master.
void RandomCase::services() {
  constexpr DpState kStates[] = {DpState::kWaitPrm, DpState::kWaitCfg, DpState::kWaitCfg, DpState::kDataExch};
  for (int i = random_.between(2, 4); i > 0; --i) {
    careful(true);
    reach(random_.pick(kStates));
    if (random_.one_in(1 + host_->slowness())) user_.diagnosis();
    for (int each = steps() / 5 + 2; each > 0; --each) master_.any_service();
    careful(false);
  }
}

/// In sequence, because the first may lock the address (S5). With the delivery address no parameters are accepted
/// (S33).
void RandomCase::addresses() {
  for (int i = random_.between(1, 3); i > 0; --i) {
    if (random_.one_in(2)) {
      careful(true);
      reach(DpState::kWaitPrm);
      address_changes();
    }
    master_.set_prm(true);
  }
}

void RandomCase::address_changes() {
  master_.careful(true);
  for (int i = random_.between(2, 3); i > 0; --i) master_.set_slave_address();
  master_.slave_diag();
  master_.careful(false);
}

/// Everything independent of the rate is covered at faster ones: this covers the receiver's and the transmitter's bits.
void RandomCase::slow_rates() {
  master_.careful(true);
  for (int i = random_.between(0, 1); i > 0; --i) master_.slave_diag();
  master_.careful(false);
}

/// The watchdog, or BAUD_CONTROL, runs out in each state (S1, S15).
void RandomCase::timeouts() {
  constexpr DpState kStates[] = {DpState::kWaitPrm, DpState::kWaitCfg, DpState::kDataExch};
  careful(true);
  if (random_.one_in(2)) {
    watchdog();
  } else {
    reach(random_.pick(kStates));
    search_again();
  }
  careful(false);
}

/// Parameters with a short watchdog, and no telegram until it has expired (S1): usually it runs on while the user
/// judges newer ones (S15).
void RandomCase::watchdog() {
  sync();
  const bool two = random_.one_in(2);
  master_.set_prm_with_watchdog(two ? 1 : random_.between(1, 2), two ? 2 : 1);
  verdict(true, false);
  if (random_.one_in(2)) master_.check_cfg(true);
  if (random_.one_in(2)) verdict(false, true);
  if (setup_.prm_mode == 2 && !random_.one_in(4)) master_.set_prm(true);
  sync();
  master_.wait_watchdog();
  master_.slave_diag();
}

/// Silence until BAUD_CONTROL has expired, then another rate (S1); the DP state stays.
void RandomCase::search_again() {
  sync();
  master_.slave_diag();
  master_.wait_baud_control();
  master_.choose_rate();
  master_.repeat_last();
}

// --- what one bit or cycle decides
// ------------------------------------------------------------------------------------

void RandomCase::single_bits() {
  constexpr void (RandomCase::*kParts[])() = {&RandomCase::repetitions, &RandomCase::both_flags, &RandomCase::groups,
                                              &RandomCase::delivery_address, &RandomCase::request_of_class_2};
  const int first = random_.below(static_cast<int>(std::size(kParts)));
  for (std::size_t i = 0; i < std::size(kParts); ++i) {
    careful(true);
    (this->*kParts[(i + static_cast<std::size_t>(first)) % std::size(kParts)])();
  }
  careful(false);
}

/// Requests that only their FCB tells apart, and each service repeated after the user has renewed its data (S26).
void RandomCase::repetitions() {
  reach(DpState::kDataExch);
  for (int i = 0; i < 2; ++i) master_.other_fcb_same_fcs();
  for (const int sap : {0, 56, 57, 59, 60}) {
    master_.in_a_series(sap);
    sync();
    user_.inputs();
    host_->wait(150);
    sync();
    master_.repeat_last();
  }
}

/// Parameters and configuration wait for the user's release, and then come in one access (P7).
void RandomCase::both_flags() {
  sync();
  host_->take();
  host_->wait(20);
  sync();
  master_.set_prm(true);
  master_.check_cfg(true);
  sync();
  host_->give();
  host_->wait(600);
  sync();
}

/// Commands to the first and the last group and to others, Sync and Freeze alone and together, and new data after each
/// (S4).
void RandomCase::groups() {
  sync();
  master_.set_prm_of_groups(0x81 | random_.byte());
  master_.check_cfg(true);
  for (int i = 0; i < 5; ++i) {
    constexpr int kCommands[] = {0x20, 0x08, 0x28, 0x28}, kGroups[] = {0x80, 0x80, 0x01, 0x02, 0x10};
    master_.command(random_.pick(kCommands), random_.pick(kGroups));
    for (int each = 0; each < 2; ++each) {
      sync();
      user_.inputs();
      master_.data_exchange();
      sync();
      host_->wait(150);
    }
    sync();
    master_.command(0x14, 0);
  }
}

/// Set_Slave_Address with addresses about the greatest (S5).
void RandomCase::delivery_address() {
  reach(DpState::kWaitPrm);
  for (const int each : {126, 127, random_.between(1, 125)}) master_.set_slave_address_to(each);
  master_.slave_diag();
}

void RandomCase::request_of_class_2() {
  const int channel = random_.between(1, 2);
  for (const int each : {1, 2}) master_.abort(each);
  for (int i = 0; i < channel; ++i) master_.initiate();
  master_.acyclic_poll(channel);
  master_.acyclic_request(channel);
  sync();
  host_->wait(400);
  sync();
}

/// A watchdog of two factors without its master, and T of 10 ms on channel 2F, which the poll for an answer extends;
/// channel 30 has a T of two bytes (S22, V12).
void RandomCase::long_timers() {
  constexpr int kTwoBytes = 0x0101, kTen = 1, kChannel = 2;
  careful(true);
  master_.set_prm_with_watchdog(1, 2);
  master_.check_cfg(true);
  for (const int timeout : {kTwoBytes, kTen}) master_.initiate(timeout);
  master_.acyclic_poll(kChannel);
  master_.acyclic_request(kChannel);
  sync();
  host_->wait(300);
  for (int i = 0; i < 2; ++i) user_.acyclic_answer(kChannel);
  host_->wait(300);
  sync();
  master_.acyclic_poll(kChannel);
  master_.wait_timer(11, false, 3);
  for (const int channel : {2, 1}) master_.acyclic_poll(channel);
  careful(false);
}

/// min_TSDR of a Set_Prm above max_TSDR (S11).
void RandomCase::late_answers() {
  careful(true);
  master_.set_prm_with_tsdr(random_.between(101, 255));
  master_.slave_diag();
  careful(false);
}

// --- the host's port ------------------------------------------------------------------------------------------------

void RandomCase::port() {
  for (int i = random_.between(2, 5); i > 0; --i) {
    random_.one_in(5) ? host_->rude() : random_.one_in(2) ? host_->break_rules() : user_.anything();
    for (int each = random_.below(4); each > 0; --each) master_.data_exchange();
    if (random_.one_in(3)) sync();
  }
}

/// An edge of the host, or RESET, in a part of a chip access caused for it.
void RandomCase::edges() {
  for (int i = random_.between(3, 8); i > 0; --i) {
    const auto part = static_cast<AccessPart>(random_.below(static_cast<int>(AccessPart::kNone)));
    sync();
    careful(true);
    random_.one_in(3) ? reset_in(part) : edge_in(part);
    careful(false);
  }
}

void RandomCase::edge_in(AccessPart part) {
  constexpr Tick kSoon = 400 * kCycle, kTelegrams = 20'000 * kCycle;  // after the action of the user or the master
  const bool by_user = cause(part);
  if (by_user) host_->hurry();
  host_->edge(part, by_user ? kSoon : kTelegrams);
  sync();
  host_->give();
  if (part == AccessPart::kStartUp || part == AccessPart::kInit) {
    host_->wait(4200);
    come_up(*theme_);
  }
  if (part == AccessPart::kPrm) master_.check_cfg(true);  // into data exchange again
}

void RandomCase::reset_in(AccessPart part) {
  constexpr Tick kBlocks = 40'000 * kCycle;  // by the slowest host
  cause(part);
  push_reset(part, kBlocks);
  stimulus_.back().delay =
      random_.between(1, random_.one_in(2) ? static_cast<int>(kCycle) - 1 : 12 * static_cast<int>(kCycle));
  sync();
  host_->give();
  host_->wait(4200);
  come_up(*theme_);
}

/// Returns true if the user causes it.
bool RandomCase::cause(AccessPart part) {
  switch (part) {
    case AccessPart::kStartUp: push_reset(); return false;
    case AccessPart::kPrm: master_.set_prm(true); return false;
    case AccessPart::kCfg: master_.check_cfg(true); return false;
    case AccessPart::kOutputs: master_.data_exchange(); return false;
    case AccessPart::kC1Request:
      reach(DpState::kDataExch);  // on the way, open requests are dropped
      master_.acyclic_request(0);
      return false;
    case AccessPart::kC2Request: {
      const int channel = random_.between(1, 2);
      for (const int each : {1, 2}) master_.abort(each);
      for (int i = 0; i < channel; ++i) master_.initiate();
      master_.acyclic_poll(channel);
      master_.acyclic_request(channel);
      return false;
    }
    case AccessPart::kInit: user_.initialise(); break;
    case AccessPart::kPrmVerdict: user_.verdict(true, false, true); break;
    case AccessPart::kCfgVerdict: user_.verdict(false, true, true); break;
    case AccessPart::kDiag: user_.diagnosis(); break;
    case AccessPart::kC1Answer: user_.acyclic_answer(0); break;
    case AccessPart::kC2Answer: user_.acyclic_answer(1); break;
    default: user_.inputs(); break;
  }
  return true;
}

}  // namespace dsdpv1::cosim

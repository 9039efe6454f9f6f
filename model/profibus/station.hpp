#pragma once
// A PROFIBUS DP slave station between PBRXD and PBTXD: receiver, baud search, watchdog, FDL and the DP services,
// evaluated in the order that docs/microarchitecture.md defines. This file is independent of the user's side: the chip
// has it as a SlaveStore.
#include <algorithm>
#include <utility>

#include "model/profibus/baud_search.hpp"
#include "model/profibus/dp_slave.hpp"
#include "model/profibus/fdl.hpp"
#include "model/profibus/telegram_rx.hpp"
#include "model/profibus/uart_rx.hpp"
#include "model/profibus/uart_tx.hpp"

namespace dsdpv1::profibus {

/// Per-chip configuration of the station: ruling parameters in cycles (bits where noted).
struct StationConfig {
  Cycle rts_lead = 4, rts_trail = 4;
  Cycle search_window = 50 * kCyclesPerMs;
  Cycle search_window_bits = 4000;
  Cycle baud_control = 600 * kCyclesPerMs;
  FcbRule fcb_rule = FcbRule::kLetter;
  SlaveRules rules;
};

class Station {
 public:
  /// `msac`: see DpSlave.
  Station(EventLog& log, const StationConfig& config, SlaveStore& store, Msac* msac);
  Station(const Station&) = delete;  // its parts refer to each other
  Station& operator=(const Station&) = delete;

  /// PBRXD changes at `at`; every rising edge up to then has been evaluated. Returns false if next() is unchanged.
  bool set_rxd(Tick at, bool level) {
    if (rx_.full()) make_room(at);
    const bool seen_again = std::exchange(for_others_, false);
    return rx_.set_line(at, level) || seen_again;
  }
  /// See UartRx::set_run. False: the edges must be passed.
  bool set_run(const CharacterRun& run);
  void leave_run(Tick at);
  bool rxd() const { return rx_.input(); }
  bool left_run() const { return rx_.left_run(); }
  void forget_run() { rx_.forget_run(); }
  /// Changes of PBRXD within this time may be passed late, before the rising edge at `until` or an earlier one at which
  /// next() is due.
  Unheard unheard() const;
  /// Telegrams that may be skipped; only the last one must be passed before any other call. pass() counts the others,
  /// `count` of them for stations.
  Unconcerned unconcerned() const;
  void pass(std::uint64_t count) { received_ += count; }
  /// Reset: everything as at power-on. The store, whose MSAC has timers, comes before.
  void reset();

  // --- commands of the user's side ----------------------------------------------------------------------------------
  /// To OFFLINE. An answer in progress is cut off.
  void stop(Cycle now);
  /// From OFFLINE to WAIT_PRM and baud search (D7, S1).
  void start(Cycle now, const SlaveConfig& config);
  /// The user accepts (`good`) or refuses what the store's kAwaited has announced; otherwise an event.
  void prm_verdict(Cycle now, bool good);
  void cfg_verdict(Cycle now, bool good);
  /// The user refuses parameters that are in force already.
  void refuse_parameters(Cycle now);
  /// The configuration is right, but its verdict waits for something else: no Cfg_Fault any more.
  void cfg_is_right() { slave_.cfg_is_right(); }
  /// The user gives up the master.
  void leave_master(Cycle now);
  /// The cells of the configuration, changed while the station runs.
  void configure(const SlaveConfig& config) { slave_.configure(config); }
  void set_address(std::uint8_t address) {
    for_others_ = for_others_ && address == slave_.address();  // the telegram in progress may be for this station now
    slave_.set_address(address);
  }
  /// In bit times: until the next Set_Prm with one.
  void set_min_tsdr(int bits) { slave_.set_min_tsdr(bits); }
  void set_baud_control(Cycle time) { watchdog_.set_baud_control(time); }  ///< see Watchdog
  void set_rules(const SlaveRules& rules) { config_.rules = rules; }
  /// Call it when a timer of MSAC may have changed.
  void plan_timers() {
    timers_ = running() ? std::min({search_.next(), watchdog_.next(), slave_.next_timer()}) : kNever;
  }

  /// The rising edge of `now`.
  void eval(Cycle now);
  /// The next cycle at which eval() has an effect, not counting unseen().
  Cycle next() const;
  /// The next cycle at which eval() processes a telegram for others that was passed as a run. Only telegrams_received()
  /// shows it, so the call may come late, before anything else concerns this station. kNever: nothing.
  Cycle unseen() const { return for_others_ ? next_of_line() : kNever; }
  /// Applies the effects of that telegram up to the edge at `upto`. Returns true if next() may have changed.
  bool catch_up(Cycle upto);

  /// Whether eval(now) may do more than receive a character or send a bit: change the mail to the user's side, or a
  /// state.
  bool may_act(Cycle now) const {
    return now >= timers_ || (!tx_.rts() && now >= telegrams_.deadline() && !rx_.completes(now));
  }

  /// Before this cycle eval() only sends bits of an answer.
  Cycle only_sends_until() const { return tx_.rts() ? std::min(tx_.end(), timers_) : 0; }
  /// As eval(), before only_sends_until(); returns next().
  Cycle send_bit(Cycle now) {
    if (now == tx_.next()) tx_.next_run();  // a planned event has become void
    return std::min(tx_.next(), timers_);
  }

  /// See UartTx.
  bool begins_to_send(Cycle now) const { return tx_.begins(now); }
  CharacterRun hide_txd() { return tx_.hide(); }
  void show_txd(Cycle now) { tx_.show(now); }

  /// From the decision on a request until PBRTS has fallen after its answer.
  bool answers() const { return tx_.planned(); }
  /// PBRTS of an answer rises at this edge, unless the answer is postponed or dropped before eval(now).
  bool begins_answer(Cycle now) const { return answers() && !tx_.rts() && now >= tx_.next(); }
  void postpone_answer(Cycle by) { tx_.postpone(by); }
  void drop_answer() { tx_.abort(); }
  int bit() const { return search_.bit(); }  ///< cycles, at the rate in use or tried

  /// Neither an answer nor, after eval(now), a telegram is in progress.
  bool quiet(Cycle now) const { return !answers() && telegrams_.deadline() == kNever && !rx_.receiving(now); }

  bool txd() const { return tx_.txd(); }
  bool rts() const { return tx_.rts(); }
  bool baud_found() const { return running() && !search_.searching(); }
  BaudIndex baud_index() const { return baud_found() ? search_.index() : kBaudUnknown; }
  const DpSlave& slave() const { return slave_; }
  /// During the search: the rate being tried.
  BaudIndex tried() const { return search_.index(); }
  Watchdog::State watchdog() const { return watchdog_.state(); }
  std::uint64_t telegrams_received() const { return received_; }
  std::uint64_t telegrams_answered() const { return answered_; }

  /// `bytes`: the store. Its `store(archive, slave)` stores both, and the slave's faults.
  template <class Archive, class Store>
  void store(Archive& archive, Store& bytes) {
    auto& [log, config, its_bytes, rx, telegrams, search, watchdog, slave, fdl, tx, timers, for_others, received,
           answered] = *this;
    archive.given(log, config, its_bytes, timers);
    archive(rx, telegrams, search, watchdog);
    bytes.store(archive, slave);
    archive(fdl);
    tx.store(archive, fdl.answer().bytes.data(), Frame::kMost);
    archive(for_others, received, answered);
    if constexpr (Archive::kReads) plan_timers();
  }

 private:
  bool running() const { return slave_.state() != DpState::kOffline; }
  bool listening() const { return running() && !tx_.rts(); }
  Cycle next_of_line() const;
  bool pass_unseen(Cycle upto);
  void make_room(Tick at);
  void listen(Cycle now);
  void select_rate(Cycle now);
  void watch(Cycle now);
  void watchdog_expired(Cycle now);
  void start_search(Cycle now);
  bool count(std::uint8_t sd);
  void decide(Cycle now, const Telegram& telegram);
  void lock(Cycle now);
  void answer(const Telegram& telegram, const Frame& frame);

  EventLog& log_;
  StationConfig config_;
  SlaveStore& store_;
  UartRx rx_;
  TelegramRx telegrams_;
  BaudSearch search_;
  Watchdog watchdog_;
  DpSlave slave_;
  Fdl fdl_;
  UartTx tx_;
  // The next end of the search, the watchdog or a C2 timer: kept, because every bit sent reads it.
  Cycle timers_ = kNever;
  bool for_others_ = false;  // the present telegram is for others and no other event waits
  std::uint64_t received_ = 0, answered_ = 0;
};

}  // namespace dsdpv1::profibus

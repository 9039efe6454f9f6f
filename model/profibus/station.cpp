#include "model/profibus/station.hpp"

#include <algorithm>

#include "model/profibus/fdl_times.hpp"

namespace dsdpv1::profibus {
namespace {

constexpr Cycle kSynchroniserDelay = 2;  // P9: the logic sees a start edge two cycles after it was sampled
constexpr Cycle kLoopDelay = 3;          // P9: an edge that the chip drives is sampled at the next edge

}  // namespace

Station::Station(EventLog& log, const StationConfig& config, SlaveStore& store, Msac* msac)
    : log_(log),
      config_(config),
      store_(store),
      telegrams_(log),
      search_(config.search_window, config.search_window_bits),
      watchdog_(config.baud_control),
      slave_(log, watchdog_, store, msac, config_.rules),
      fdl_(log, config.fcb_rule) {}

void Station::reset() {
  slave_.reset();
  watchdog_.baud_search();
  search_.lock();
  telegrams_.reset();
  fdl_.forget();
  tx_.abort();
  for_others_ = false;
  received_ = answered_ = 0;
  plan_timers();
}

void Station::stop(Cycle now) {
  tx_.abort();
  for_others_ = false;  // a run may have been passed before its begin
  slave_.stop(now);
  plan_timers();
}

void Station::start(Cycle now, const SlaveConfig& config) {
  slave_.start(now, config);
  start_search(now);
  plan_timers();
}

void Station::prm_verdict(Cycle now, bool good) {
  slave_.prm_verdict(now, good);
  plan_timers();
}

void Station::cfg_verdict(Cycle now, bool good) {
  slave_.cfg_verdict(now, good);
  plan_timers();
}

void Station::refuse_parameters(Cycle now) {
  slave_.refuse_prm(now);
  plan_timers();
}

void Station::leave_master(Cycle now) {
  slave_.leave_master(now);
  plan_timers();
}

Cycle Station::next() const {
  if (!running()) return tx_.next();
  const Cycle next = std::min(tx_.next(), timers_);
  return tx_.rts() || for_others_ ? next : std::min(next, next_of_line());
}

Cycle Station::next_of_line() const {
  const Cycle decision = telegrams_.deadline();
  return std::min(rx_.next(), rx_.receiving(decision) ? kNever : decision);
}

// All of it at once, if it was received and decided.
bool Station::pass_unseen(Cycle upto) {
  const bool passes = for_others_ && rx_.whole_run(upto) && TelegramRx::decided(rx_.run_end(), rx_.bit()) <= upto &&
                      telegrams_.pass_whole(rx_.run_idle(), rx_.bit());
  if (!passes) return false;
  count(*rx_.run_bytes());
  rx_.take_run();
  for_others_ = false;
  return true;
}

bool Station::catch_up(Cycle upto) {
  if (pass_unseen(upto)) return false;
  bool evaluates = false;
  for (Cycle cycle = unseen(); cycle <= upto; cycle = unseen()) {
    eval(cycle);
    evaluates = true;
  }
  return evaluates;
}

Unheard Station::unheard() const {
  if (!running()) return {0, kNever};
  return tx_.rts() ? Unheard{0, tx_.released() * kTicksPerCycle} : rx_.unheard();
}

// During the search, or while this chip answers, the result cannot be predicted.
bool Station::set_run(const CharacterRun& run) {
  if (!listening() || search_.searching() || tx_.planned()) return false;
  const int to = telegrams_.takes_whole() ? addressee(run.bytes, static_cast<std::size_t>(run.size)) : kNoTelegram;
  if (!rx_.set_run(run, to != kNoTelegram)) return false;
  for_others_ = to != kNoTelegram && to != slave_.address() && to != kBroadcast;
  return true;
}

Unconcerned Station::unconcerned() const {
  constexpr int kGapBits = 2;  // more than S10 allows within a telegram, whatever its position between two edges
  const bool takes_whole = listening() && !search_.searching() && !tx_.planned() && telegrams_.takes_whole();
  const Cycle idle = takes_whole && (for_others_ || !rx_.in_run()) ? rx_.idle_from() : kNever;
  if (idle == kNever) return {};
  return {(idle + kGapBits * rx_.bit()) * kTicksPerCycle, rx_.bit(), slave_.address()};
}

void Station::leave_run(Tick at) {
  if (listening()) listen(at / kTicksPerCycle);
  rx_.leave_run(at);
  for_others_ = false;
}

/// Drops edges without loss: those up to now belong to a character in progress, or the receiver is deaf.
void Station::make_room(Tick at) {
  const Cycle now = at / kTicksPerCycle;
  if (listening())
    rx_.eval(now);
  else
    rx_.skip(now);
}

void Station::eval(Cycle now) {
  if (running()) {
    if (!tx_.rts()) listen(now);
    watch(now);
    const bool decided = !tx_.rts() && telegrams_.eval(now, rx_.receiving(now));
    if (!rx_.in_run() && telegrams_.deadline() == kNever) for_others_ = false;
    if (decided) decide(now, telegrams_.telegram());
    if (decided || now >= timers_) plan_timers();
  }
  const bool was_sending = tx_.rts();
  if (tx_.eval(now)) rx_.restart(search_.bit(), now, tx_.end() + kLoopDelay);
  if (was_sending || !tx_.rts()) return;
  ++answered_;
  telegrams_.cut(now);  // half duplex: characters received now are our own echo
}

void Station::listen(Cycle now) {
  const bool whole = rx_.whole_run(now);
  if (whole && telegrams_.take_whole(rx_.run_bytes(), rx_.run_size(), rx_.run_idle(), rx_.run_end(), rx_.bit()))
    rx_.take_run();
  while (rx_.eval(now)) telegrams_.character(rx_.completed(), rx_.character(), rx_.bit());
}

// --- baud rate and watchdog (S1) -------------------------------------------------------------------------------------

void Station::start_search(Cycle now) {
  log_.at_cycle(now, Reason::kBaudSearch);
  store_.baud(now, kBaudUnknown);
  watchdog_.baud_search();
  search_.start(now);
  select_rate(now);
}

void Station::select_rate(Cycle now) {
  for_others_ = false;
  rx_.restart(search_.bit(), now, now);
  telegrams_.restart();
  telegrams_.set_quiet(search_.searching());
  fdl_.forget();
}

void Station::watch(Cycle now) {
  if (search_.eval(now)) select_rate(now);
  if (watchdog_.expired(now)) watchdog_expired(now);
  slave_.eval_timers(now);
}

void Station::watchdog_expired(Cycle now) {
  if (watchdog_.state() == Watchdog::State::kDpControl) {
    slave_.watchdog_expired(now);
  } else {
    log_.at_cycle(now, Reason::kBaudLost, static_cast<unsigned>(watchdog_.baud_control_time() / kCyclesPerMs));
    start_search(now);
  }
}

void Station::lock(Cycle now) {
  search_.lock();
  telegrams_.set_quiet(false);
  log_.at_cycle(now, Reason::kBaudFound, static_cast<unsigned>(search_.index().code()));
  store_.baud(now, search_.index());
  slave_.rate_found(now);
}

// --- telegrams -------------------------------------------------------------------------------------------------------

/// Returns false for a telegram without a function, which is not counted.
bool Station::count(std::uint8_t sd) {
  const bool counts = sd != sd::kSc && sd != sd::kSd4;
  if (counts) ++received_;
  return counts;
}

void Station::decide(Cycle now, const Telegram& telegram) {
  if (!count(telegram.sd)) return;
  if (search_.searching()) {
    if (telegram.synced) lock(now);
    return;  // S9: the telegram that locks the rate is not executed
  }
  Request request;
  if (!fdl_.addressed(now, telegram, slave_.address(), request)) return;
  if (request.da != kBroadcast) watchdog_.trigger(now, request.sa == slave_.master());
  if (const Frame* frame = fdl_.execute(now, telegram, request, slave_)) answer(telegram, *frame);
}

void Station::answer(const Telegram& telegram, const Frame& frame) {
  const Cycle begin = telegram.end - kSynchroniserDelay + tsdr(slave_.min_tsdr(), search_.max_tsdr(), search_.bit());
  tx_.send(frame.bytes.data(), frame.size, search_.bit(), begin, config_.rts_lead, config_.rts_trail);
}

}  // namespace dsdpv1::profibus

#include "kinds/dsdpv1/checks/fresh_data.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/baud.hpp"

namespace dsdpv1::checks {
namespace {

constexpr std::uint8_t kLock = 0x80, kUnlock = 0x40, kWatchdogOn = 0x08, kBase1Ms = 0x04;  // tables 19 to 21
constexpr std::size_t kStatus = 0, kFactor1 = 1, kFactor2 = 2, kDpv1Status = 7;            ///< bytes of Set_Prm
constexpr std::size_t kShortestPrm = 7;

/// S1.
Tick watchdog_of(const bus::Bytes& prm) {
  if ((prm[kStatus] & kWatchdogOn) == 0) return 0;
  const bool base_1ms = prm.size() > kDpv1Status && (prm[kDpv1Status] & kBase1Ms) != 0;
  return Tick{prm[kFactor1]} * prm[kFactor2] * (base_1ms ? 1 : 10) * bus::kTicksPerMs;
}

/// A read, write or transport on C1 or an open C2 channel (tables 24, 26, 31).
bool is_for_user(const bus::Telegram& asked) {
  constexpr std::uint8_t kFirstChannel = 47, kLastChannel = 48;
  const bool on_channel = asked.dsap == bus::sap::kMs1 || (asked.dsap >= kFirstChannel && asked.dsap <= kLastChannel);
  if (!on_channel || asked.data.empty()) return false;
  const std::uint8_t function = asked.data[0];
  return function == regs::kFunctionNumRead || function == regs::kFunctionNumWrite ||
         function == regs::kFunctionNumTransport;
}

/// A Set_Prm that is to parameterise (table 20).
bool parameterises(const bus::Bytes& prm) {
  return prm.size() >= kShortestPrm && (prm[kStatus] & (kLock | kUnlock)) == kLock;
}

bool has_usual_limit(const Recorder& recorder, Check check) { return recorder.limit(check).value == rule(check).limit; }

}  // namespace

FreshData::FreshData(Recorder& recorder, const OwnStation& station)
    : recorder_(recorder),
      station_(station),
      outputs_follow_(has_usual_limit(recorder, Check::kOutputsFetched)),
      inputs_follow_(has_usual_limit(recorder, Check::kInputsRenewed)) {}

void FreshData::reset() {
  leave();
  limit(0);
}

// --- telegrams -------------------------------------------------------------------------------------------------------

/// Refusals are SD1 with another function code (S20); an answer without inputs is SC or SD1 (S19).
bool FreshData::telegram(const bus::WireTelegram& telegram) {
  const bus::WireTelegram* const asked = station_.answered();
  if (asked == nullptr) return false;
  const bus::Telegram &request = asked->decoded.telegram, &answer = telegram.decoded.telegram;
  const bool sc = answer.kind == bus::TelegramKind::kSc;
  if (station_.is_exchange(*asked)) {
    const bool data = answer.function() == bus::fc::kDl || answer.function() == bus::fc::kDh;
    const Tick executed = asked->end + bus::baud(asked->baud).bit;
    if (sc || data) exchanged(executed, !request.data.empty(), !sc && !answer.data.empty());
  } else if (sc && request.dsap == bus::sap::kSetPrm && parameterises(request.data)) {
    leave();
    limit(watchdog_of(request.data));
  }
  return sc && is_for_user(request);
}

// --- data exchange ---------------------------------------------------------------------------------------------------

/// The limit of both: the time for which the master may be silent (U4).
void FreshData::limit(Tick watchdog) {
  const Tick usual = watchdog != 0 ? watchdog : rule(Check::kOutputsFetched).limit;
  if (outputs_follow_) recorder_.set_limit(Check::kOutputsFetched, usual);
  if (inputs_follow_) recorder_.set_limit(Check::kInputsRenewed, usual);
}

void FreshData::leave() {
  exchange_.reset();
  interval_.reset();
  outputs_.ends();
  inputs_.ends();
  overwritten_ = 0;
}

/// After a long silence data exchange has begun again.
void FreshData::exchanged(Tick at, bool outputs, bool inputs) {
  if (exchange_ && at - *exchange_ > recorder_.limit(Check::kOutputsFetched).value) leave();
  if (exchange_) interval_ = at - *exchange_;
  exchange_ = at;
  if (outputs && (!fetching_ || *fetching_ < at)) {  // not fetched before the answer was over
    overwritten_ += outputs_.since() ? 1 : 0;
    outputs_.begins(at);
  }
  if (inputs) inputs_.begins(at);
  pass(at);
}

/// `at`, or the end of data exchange if that was sooner: one may be lost on the line. Absent if only one Data_Exchange
/// was heard.
std::optional<Tick> FreshData::exchanging_at(Tick at) const {
  return interval_ ? std::optional(std::min(at, *exchange_ + 2 * *interval_)) : std::nullopt;
}

void FreshData::pass(Tick now) {
  const std::optional<Tick> at = exchanging_at(now);
  if (!at) return;
  outputs_.pass(
      recorder_, Check::kOutputsFetched, *at,
      [this] { return fmt::format("B00E.0, outputs: not cleared, {} newer ones have come", overwritten_); });
  inputs_.pass(recorder_, Check::kInputsRenewed, *at, [] { return std::string("B010.0 was not set"); });
}

/// Without data exchange the duty is void.
void FreshData::met(Duty& duty, Check check, Tick at, const char* what) {
  const std::optional<Tick> until = exchanging_at(at);
  if (!until || !duty.since() || *until < *duty.since()) return duty.ends();
  duty.met(recorder_, check, *until, [what] { return std::string(what); });
}

void FreshData::hold(const UserHold& hold) {
  outputs_in(hold);
  if (!hold.user_1.written || (hold.user_1.after & regs::kUserCommand1Input) == 0) return;
  met(inputs_, Check::kInputsRenewed, hold.ended, "B010.0 set again");
  if (exchange_) inputs_.begins(hold.ended);
}

/// A look that finds B00E.0 clear shows that nothing has come for the user, as in Sync mode (S4).
void FreshData::outputs_in(const UserHold& hold) {
  const FlagsInHold& flags = hold.chip_1;
  const bool cleared = (flags.fetched() & regs::kChipCommand1Output) != 0;
  const bool found_clear = flags.looked_at() && (flags.after & regs::kChipCommand1Output) == 0 && outputs_.since() &&
                           hold.began > *outputs_.since();
  if (cleared) {
    overwritten_until(hold.ended);
    met(outputs_, Check::kOutputsFetched, hold.ended, "B00E.0 cleared");
    fetching_ = hold.began;
  } else if (found_clear) {
    outputs_.ends();
  }
  if (cleared || found_clear) overwritten_ = 0;
}

void FreshData::overwritten_until(Tick at) {
  const std::optional<Tick> since = outputs_.since();
  if (since)
    recorder_.value(
        Check::kOutputsOverwritten, *since, Tick{overwritten_}, [] { return std::string("outputs in a row"); },
        Act::omitted(*since, at));
}

void FreshData::finish(Tick end) {
  pass(end);
  overwritten_until(end);
}

}  // namespace dsdpv1::checks

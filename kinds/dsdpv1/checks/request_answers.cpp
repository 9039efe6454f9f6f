#include "kinds/dsdpv1/checks/request_answers.hpp"

#include <fmt/format.h>

#include <utility>

namespace dsdpv1::checks {
namespace {

constexpr std::uint8_t kError = 0x80;  ///< bit of Function_Num (tables 27, 32)
constexpr std::uint16_t kTimerU = 3;   ///< in C2_TIMEOUT
constexpr std::size_t kC1 = 0, kC2 = 1;
constexpr Tick kC2Limit = bus::kTicksPerSecond;            ///< of a chip that does not tell when U has ended (U8)
constexpr std::size_t kFirstOfChip = 3, kFirstOfUser = 3;  ///< C1 in kChipBlocks, kUserBlocks; C2 follows

/// V6, and a read gives no more than was asked for. An error repeats the function only.
bool fits(const AcyclicHeader& asked, const AcyclicHeader& given) {
  if (((asked[0] ^ given[0]) & ~kError) != 0) return false;
  if ((given[0] & kError) != 0) return true;
  const bool too_long = asked[0] == regs::kFunctionNumRead && given[3] > asked[3];
  return asked[1] == given[1] && asked[2] == given[2] && !too_long;
}

std::string text_of(const AcyclicHeader& header) {
  return fmt::format("{:02X} {:02X} {:02X} {:02X}", header[0], header[1], header[2], header[3]);
}

}  // namespace

void RequestAnswers::hold(const UserHold& hold, const UserHolds& holds) {
  if (hold.initialises()) return reset();
  for (std::size_t which = 0; which < channels_.size(); ++which) serve(which, hold, holds);
}

/// A request that stands in B00F is newer than the one that was fetched: that is withdrawn (V13).
void RequestAnswers::serve(std::size_t which, const UserHold& hold, const UserHolds& holds) {
  Channel& channel = channels_.at(which);
  const Block& request = kChipBlocks.at(kFirstOfChip + which);
  const Block& answer = kUserBlocks.at(kFirstOfUser + which);
  if ((hold.chip_2.fetched() & request.flag) != 0) {
    if (which == kC1) c1_unfetched_ = false;
    channel.asked = holds.request_read(request);
    channel.duty.ends();
    channel.duty.begins(hold.ended);
  }
  if ((hold.user_2.set() & answer.flag) != 0 && channel.duty.since())
    answered(which, holds.answer_written(which), hold.ended);
  if ((hold.chip_2.after & request.flag) != 0) channel.duty.ends();
}

/// C2 has no margin: its limit is the master's.
void RequestAnswers::answered(std::size_t which, const AcyclicHeader& given, Tick at) {
  judge(which, given, at);
  const auto text = [which] { return std::string(kChipBlocks.at(kFirstOfChip + which).name); };
  Duty& duty = channels_.at(which).duty;
  if (which == kC1) return duty.met(recorder_, Check::kRequestAnswered, at, text);
  recorder_.kept(Check::kRequestAnswered, at, true, text);
  duty.ends();
}

void RequestAnswers::judge(std::size_t which, const AcyclicHeader& given, Tick at) {
  const std::optional<AcyclicHeader>& asked = channels_.at(which).asked;
  if (!asked || fits(*asked, given)) return;
  recorder_.kept(
      Check::kRequestAnswered, at, false,
      [&] { return fmt::format("C{}: {} answers {}", which + 1, text_of(given), text_of(*asked)); },
      Act::written(regs::kUserCommand2, at));
}

/// The master of C1 asks again only after the answer (V8), or after data exchange was left. Then an answer of the
/// earlier request with the same header passes for that of the new one: the chip cannot tell (V14).
void RequestAnswers::c1_answered(Tick at, bool owned) {
  if (std::exchange(c1_unfetched_, false) && owned)
    recorder_.kept(
        Check::kRequestAnswered, at, false,
        [] { return std::string("C1: answered before it was fetched, as an earlier request may be"); },
        Act::written(regs::kUserCommand2, at));
}

void RequestAnswers::event(const profibus::Event& event, bool owned) {
  if (event.reason == profibus::Reason::kC1Request) c1_unfetched_ = true;
  if (event.reason == profibus::Reason::kC1Answer) c1_answered(event.at, owned);
  if (event.reason == profibus::Reason::kC1Dropped) {
    channels_.at(kC1).duty.ends();
    c1_unfetched_ = false;
  }
  if (event.reason == profibus::Reason::kC2Timeout && event.b == kTimerU)
    no_answer_on_c2(event.at, "C2: no answer within Send_Timeout");
}

void RequestAnswers::no_answer_on_c2(Tick at, const char* text) {
  Duty& duty = channels_.at(kC2).duty;
  recorder_.kept(
      Check::kRequestAnswered, at, false, [text] { return std::string(text); },
      Act::omitted(duty.since().value_or(at), at));
  duty.ends();
}

void RequestAnswers::pass(Tick now, bool chip_tells) {
  channels_.at(kC1).duty.pass(recorder_, Check::kRequestAnswered, now, [] { return std::string("C1: no answer"); });
  const std::optional<Tick> since = channels_.at(kC2).duty.since();
  if (!chip_tells && since && now - *since > kC2Limit) no_answer_on_c2(now, "C2: no answer");
}

}  // namespace dsdpv1::checks

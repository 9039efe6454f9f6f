#include "kinds/xgate/link_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "model/xgate/mailbox.hpp"

namespace dsdpv1::xgate_checks {
namespace {

using xgate::HostFrame;

constexpr std::uint8_t kExchange = 0x20, kExchangeKnown = 0x21, kRequests = 0x30, kDiagnosis = 0x31;
constexpr std::uint8_t kSegments = 0x33, kOneOfOne = 0x11, kIdle = 0xFF, kBusError = 3;

std::string words(const HostFrame& frame) { return fmt::format("command {:02X}", frame.frame.command); }

bool begins(const HostFrame& frame) { return frame.bytes.front() == xgate::kFrameStart; }
bool is_cut(const HostFrame& frame) {
  return begins(frame) && (frame.bytes.size() < xgate::kFrameHead ||
                           frame.bytes.size() < xgate::kFrameHead + std::size_t{frame.bytes[2]} + 1);
}
bool is_error(const HostFrame& frame) { return (frame.frame.special & xgate::kErrorFlag) != 0; }

std::vector<std::uint8_t> ids_of(const HostFrame& frame, xgate::MailboxForm form) {
  std::vector<std::uint8_t> ids;
  xgate::Mailbox box;
  for (xgate::MailboxReader reader(frame.frame, form); !reader.at_end() && reader.read(box);) ids.push_back(box.id);
  return ids;
}

}  // namespace

void LinkRules::reset(Tick at, bool low) {
  for (checks::Duty* duty : {&int_, &parameters_, &alarm_}) duty->ends();
  queue_.clear();
  early_ = answered_ = released_ = std::nullopt;
  last_answer_ = -1;
  opens_ = bus::kNever;
  if (low) return;
  released_ = at;
  opens_ = at + Tick{config_.power_up} * profibus::kTicksPerCycle;
}

void LinkRules::interrupt(Tick at, bool low) {
  if (low) return int_.begins(at);
  int_.met(recorder_, Check::kIntServed, at, [] { return std::string("it rose late"); });
}

void LinkRules::byte(Tick end, Tick last_end) {
  recorder_.value(
      Check::kFrameGap, end, end - last_end, [] { return std::string("the byte before it"); });
}

// --- commands --------------------------------------------------------------------------------------------------------

/// After /Rst.
void LinkRules::first(Tick start) {
  if (!released_) return;
  recorder_.value(Check::kResetAwaited, start, start - *released_, [] { return std::string("the first byte"); });
  released_.reset();
}

void LinkRules::command(const HostFrame& frame) {
  first(frame.start);
  if (frame.start < opens_) return;
  if (!frame.heard) return unheard(frame.start);
  if (const auto ended = std::exchange(answered_, std::nullopt); ended && by_uart()) early(frame.start, *ended);
  judge_form(frame);
  if (frame.wrong.empty()) fulfil(frame);
}

void LinkRules::judge_form(const HostFrame& frame) {
  if (is_cut(frame))
    return recorder_.value(
        Check::kFrameGap, frame.end, gap_ + profibus::kTicksPerCycle,
        [&] { return fmt::format("no byte after {} of a frame", frame.bytes.size()); });
  const bool rests = !by_uart() && std::all_of(frame.bytes.begin(), frame.bytes.end(),
                                               [](std::uint8_t byte) { return byte == kIdle; });
  if (rests) return;
  const bool segments = (frame.frame.special & kSegments) == kOneOfOne;
  recorder_.kept(Check::kFrameForm, frame.end, begins(frame) && segments && frame.wrong.empty(), [&] {
    if (!begins(frame))
      return fmt::format("{:02X} outside of a frame, which begins with 7E", fmt::join(frame.bytes, " "));
    return words(frame) + ": " + (segments ? frame.wrong : "not segment 1 of 1");
  });
}

void LinkRules::fulfil(const HostFrame& frame) {
  const auto text = [&] { return words(frame); };
  const std::uint8_t command = frame.frame.command;
  const bool exchange =
      command == kExchange || command == kExchangeKnown || command == kRequests || command == kDiagnosis;
  if (exchange) int_.met(recorder_, Check::kIntServed, frame.end, text);
  if (command == kRequests) given_ = frame;
  if (command == kExchangeKnown) parameters_.met(recorder_, Check::kParametersTaken, frame.end, text);
  if ((frame.frame.special & xgate::kAlarmFlag) != 0) alarm_.met(recorder_, Check::kAlarmCleared, frame.end, text);
}

// --- answers ---------------------------------------------------------------------------------------------------------

void LinkRules::early(Tick start, Tick answered) {
  recorder_.value(
      Check::kAnswerAwaited, start, start - answered, [] { return std::string("the end of the answer"); });
}

/// Known when it has ended, which may be after the answer.
void LinkRules::unheard(Tick start) {
  if (!by_uart()) return;
  if (start <= last_answer_) return early(start, last_answer_);
  if (!early_) early_ = start;
}

void LinkRules::answer(const HostFrame& frame) {
  last_answer_ = frame.end - half_bit_;
  answered_ = last_answer_;
  if (const auto start = std::exchange(early_, std::nullopt)) early(*start, last_answer_);
  if (is_error(frame) && frame.frame.size() > 0 && frame.frame.at(0) == kBusError) {
    queue_.clear();  // data exchange was left
    parameters_.ends();
  }
  if (!is_error(frame)) requests(frame);
  if (frame.asked == kExchange && frame.frame.command == kExchangeKnown) parameters_.begins(frame.end);
  if ((frame.frame.special & xgate::kAlarmFlag) != 0)
    alarm_.begins(frame.end);
  else
    alarm_.ends();
}

/// A right answer to 30 ends the requests that 30 has answered, one to 20 has those that are still open.
void LinkRules::requests(const HostFrame& frame) {
  if (frame.asked == kRequests)
    for (const std::uint8_t id : ids_of(given_, config_.mailboxes))
      queue_[id].met(recorder_, Check::kQueueAnswered, given_.end, [&] { return words(given_); });
  if (frame.asked != kExchange) return;
  std::map<std::uint8_t, checks::Duty> open;
  if (frame.frame.command == kRequests)
    for (const std::uint8_t id : ids_of(frame, config_.mailboxes)) (open[id] = queue_[id]).begins(frame.end);
  queue_ = std::move(open);
}

// --- time ------------------------------------------------------------------------------------------------------------

void LinkRules::pass(Tick now) {
  int_.pass(recorder_, Check::kIntServed, now, [] { return std::string("it is low still"); });
  for (auto& [id, duty] : queue_) {
    const int request = id;
    duty.pass(recorder_, Check::kQueueAnswered, now,
              [request] { return fmt::format("no command 30 for the request with id {}", request); });
  }
  parameters_.pass(
      recorder_, Check::kParametersTaken, now, [] { return std::string("no command 21"); });
  alarm_.pass(recorder_, Check::kAlarmCleared, now, [] { return std::string("no command with special bit 6"); });
}

}  // namespace dsdpv1::xgate_checks

#include "lab/accept/facts.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "tb/chip/chip_kind.hpp"
#include "tb/scenario/event_codes.hpp"

namespace dsdpv1::tb::accept {
namespace {

constexpr Tick kAfterRelease = 2 * bus::kTicksPerUs;

bool is(const profibus::Event& event, const char* code) { return std::strcmp(profibus::code(event.reason), code) == 0; }

}  // namespace

Facts::Facts(const scenario::Scenario& scenario, std::uint8_t device)
    : scenario_(scenario),
      kind_(*scenario.kind),
      device_(device),
      interrupt_(kind_.board_pins().interrupt),
      hold_pins_(kind_.busy_times().empty() ? 0 : kind_.busy_times().front().pins) {}

std::uint64_t Facts::count(const std::string& fact, Tick from, Tick to) const {
  const auto times = facts_.find(fact);
  if (times == facts_.end()) return 0;
  return static_cast<std::uint64_t>(
      std::count_if(times->second.begin(), times->second.end(), [from, to](Tick at) { return at >= from && at < to; }));
}

// --- the user's side -------------------------------------------------------------------------------------------------

void Facts::begins(std::size_t /*slave*/, const ChipView& chip) { interrupts_ = chip.level(interrupt_) == 0; }

void Facts::pin(std::size_t /*slave*/, Tick at, PinNumber pin, Level level) {
  if (pin == interrupt_) {
    const bool before = std::exchange(interrupts_, level == 0);
    if (interrupts_ && !before) interrupted(at);
  } else if ((hold_pins_ & mask_of(pin)) != 0) {
    if (high_ == 0 && level != 0 && interrupts_) add("request in interrupt", at);
    high_ = level != 0 ? high_ | mask_of(pin) : high_ & ~mask_of(pin);
    holds(at, high_ == hold_pins_);
  }
}

void Facts::interrupted(Tick at) {
  add("interrupt", at);
  if (holds_) return add("interrupt inside", at);
  if (high_ != 0) return add("interrupt waiting", at);
  if (at - released_ < kAfterRelease) add("interrupt released", at);
}

void Facts::holds(Tick at, bool holds) {
  if (holds_ && !holds) released_ = at;
  holds_ = holds;
}

// --- the chip --------------------------------------------------------------------------------------------------------

void Facts::event(std::size_t /*slave*/, const profibus::Event& event) {
  const char* const code = profibus::code(event.reason);
  add(code, event.at);
  if (profibus::severity(event.reason) == profibus::Severity::kViolation) violations_.push_back({event.at, code});
  if (is(event, "INITIALISED")) address_ = event.a;
  if (is(event, "DP_STATE") && event.b == static_cast<unsigned>(profibus::DpState::kDataExch))
    add("in data exchange", event.at);
  if (is(event, "SPI_CLAIMED")) holds(event.at, true);
  if (is(event, "SPI_RELEASED") || is(event, "SPI_U_TIMER")) holds(event.at, false);
  judged(event);
  answered(event);
}

void Facts::judged(const profibus::Event& event) {
  const std::string code = profibus::code(event.reason);
  const std::string block = code.substr(0, 3);
  if (block != "PRM" && block != "CFG") return;
  if (code.substr(3) == "_TO_USER") {
    if (!with_user_.insert(block).second) add("newer block", event.at);
  } else {
    with_user_.erase(block);
  }
}

/// Bit 7 of the answer's first byte: an error.
void Facts::answered(const profibus::Event& event) {
  constexpr unsigned kError = 0x80;
  if (is(event, "C1_ANSWER")) add((event.a & kError) != 0 ? "C1 error" : "C1 data", event.at);
  if (is(event, "C2_ANSWER")) add((event.b & kError) != 0 ? "C2 error" : "C2 data", event.at);
}

void Facts::action(std::size_t /*slave*/, Tick at, const std::string& words) {
  if (words == "reads a wrong bit") add("spoilt", at);
}

// --- the line --------------------------------------------------------------------------------------------------------

void Facts::telegram(const HeardTelegram& heard) {
  if (!heard.telegram.right()) return;
  const bus::Telegram& request = heard.telegram.decoded.telegram;
  const bool srd = request.function() == bus::fc::kSrdLow || request.function() == bus::fc::kSrdHigh;
  if (!request.is_request() || !srd || request.da != device_ || request.dsap || request.data == outputs_) return;
  outputs_ = request.data;
  add("new outputs", heard.now);
}

// --- violations ------------------------------------------------------------------------------------------------------

void Facts::violated(const std::string& /*slave*/, const checks::Violation& violation, const char* /*kind*/) {
  violations_.push_back({violation.at, kind_.rules()[violation.check.index].id});
}

void Facts::flag(const bus::Flag& flag) {
  const std::string code = scenario::flag_code(flag.kind);
  if (flag.kind != bus::FlagKind::kUnanswered && !scenario::allows(scenario_, code, "bus"))
    violations_.push_back({flag.at, code});
}

void Facts::user_failed(std::size_t /*slave*/, Tick at, const std::string& /*why*/, const std::string& /*registers*/) {
  violations_.push_back({at, "a fault of the processor"});
}

void Facts::acts(const scenario::Action& /*action*/, Tick now) {
  if (!begun_) begun_ = now;
}

}  // namespace dsdpv1::tb::accept

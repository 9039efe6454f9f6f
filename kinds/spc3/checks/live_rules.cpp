#include "kinds/spc3/checks/live_rules.hpp"

#include <fmt/format.h>

#include "bus/baud.hpp"

namespace dsdpv1::spc3_checks {

void LiveRules::reset() {
  station_.reset();
  leave();
  count_ = loaded_ = 0;
  told_ = false;
}

// --- DATA_EX ---------------------------------------------------------------------------------------------------------

void LiveRules::enter(Tick at) {
  exchanging_ = true;
  if (chip_.cell(regs::kOrgDinLength) == 0) return;
  recorder_.kept(Check::kLiveFirst, at, chip_.has_inputs(), [] { return "DATA_EX, and New_Din was never read"; });
  inputs_.begins(at);
}

void LiveRules::leave() {
  exchanging_ = false;
  outputs_.ends();
  inputs_.ends();
  unfetched_ = 0;
}

void LiveRules::telegram(const bus::WireTelegram& telegram) {
  station_.telegram(telegram);
  const bus::WireTelegram* const asked = station_.answered();
  if (asked == nullptr || !station_.is_exchange(*asked)) return;
  const bus::Telegram& answer = telegram.decoded.telegram;
  const bool data = answer.function() == bus::fc::kDl || answer.function() == bus::fc::kDh;
  if (data || answer.kind == bus::TelegramKind::kSc)
    exchanged(asked->end + bus::baud(asked->baud).bit, !asked->decoded.telegram.data.empty());
}

void LiveRules::exchanged(Tick at, bool outputs) {
  count(at);
  if (outputs_.since() && interrupt_.shows_no_outputs()) outputs_.ends();
  if (!exchanging_ || !outputs || fetched_ >= at) return;
  if (!outputs_.since()) unfetched_ = 0;
  outputs_.begins(at);
  ++unfetched_;
}

void LiveRules::pass(Tick now) {
  outputs_.pass(
      recorder_, Check::kLiveOutputs, now, [this] { return fmt::format("outputs of {} data telegrams", unfetched_); });
  inputs_.pass(recorder_, Check::kLiveInputs, now, [] { return "no New_Din"; });
}

// --- the user --------------------------------------------------------------------------------------------------------

void LiveRules::accessed(const RegisterAccess& access) {
  if (access.write) {
    const bool serves = access.address == regs::kMode1S && (access.value & regs::kMode1ResUserWd) != 0;
    if (serves && chip_.online() && !told_)
      recorder_.value(Check::kLiveWatchdog, access.at, used(), [] { return "per cent"; });
  } else if (access.address == regs::kNextDout) {
    outputs_.met(recorder_, Check::kLiveOutputs, access.at,
                 [this] { return fmt::format("outputs of {} data telegrams", unfetched_); });
    fetched_ = access.at;
  } else if (access.address == regs::kNewDin) {
    inputs_.met(recorder_, Check::kLiveInputs, access.at, [] { return "New_Din"; });
    if (exchanging_) inputs_.begins(access.at);
  } else if (looks_in_vain(access)) {
    outputs_.ends();
  }
}

bool LiveRules::looks_in_vain(const RegisterAccess& access) const {
  constexpr std::uint8_t kDxOut = regs::kEventDxOut >> 8;
  return (access.address == regs::kDoutSm && (access.value & regs::kSmN) == 0) ||
         (access.address == regs::kIrr + 1 && (access.value & kDxOut) == 0);
}

// --- the user watchdog -----------------------------------------------------------------------------------------------

Tick LiveRules::used() const {
  constexpr Tick kMost = 0x10000, kPerCent = 100;
  return count_ * kPerCent / (loaded_ == 0 ? kMost : loaded_);
}

void LiveRules::count(Tick at) {
  if (chip_.takes_res_user_wd(at)) {
    constexpr Tick kMost = 0x10000;
    const Tick value = chip_.cell(regs::kOrgUserWd) | chip_.cell(regs::kOrgUserWd + 1) << 8;
    loaded_ = value == 0 ? kMost : value;
    count_ = 0;
    told_ = false;
    return;
  }
  ++count_;
  if (!told_ && used() > recorder_.limit(Check::kLiveWatchdog).value) {
    told_ = true;
    recorder_.value(Check::kLiveWatchdog, at, used(),
                    [this] { return fmt::format("per cent: {} data telegrams without Res_User_Wd", count_); });
  }
}

}  // namespace dsdpv1::spc3_checks

#include "kinds/dsdpv1/checks/served_blocks.hpp"

#include <utility>

namespace dsdpv1::checks {
namespace {

constexpr std::size_t kFirst = 1;  ///< in kChipBlocks: the outputs before it are of U4

/// "B00E.1, parameters".
std::string flag_text(const Block& block) { return flag_name(block.command, block.flag) + ", " + block.name; }

}  // namespace

void ServedBlocks::reset() {
  owe_nothing();
  modes_.reset();
  coming_modes_.reset();
}

void ServedBlocks::owe_nothing() {
  intr0_.ends();
  request_.ends();
  flags_ = {};
  verdicts_ = {};
}

void ServedBlocks::hold(const UserHold& hold, const UserHolds& holds) {
  pass(hold.ended);
  note_modes(hold);
  if (hold.initialises()) return initialise(holds);
  judge_whole(hold, holds);
  judge_flags(hold);
  judge_verdicts(hold);
}

/// Flags of the earlier operation are set aside (D11).
void ServedBlocks::initialise(const UserHolds& holds) {
  owe_nothing();
  coming_modes_ = {holds.prm_mode(), holds.cfg_mode()};
}

/// A refused initialisation leaves the earlier modes in force (D11).
void ServedBlocks::note_modes(const UserHold& hold) {
  if (!coming_modes_ || !hold.initialised) return;
  if (*hold.initialised) modes_ = coming_modes_;
  coming_modes_.reset();
}

bool ServedBlocks::is_judged_by_user(std::size_t kind) const {
  return modes_ && modes_->at(kind) == regs::kPrmModeUser;
}

void ServedBlocks::judge_whole(const UserHold& hold, const UserHolds& holds) {
  if (hold.what != HoldOf::kDpram) return;
  for (const Block& block : kChipBlocks) {
    if ((hold.chip(block).cleared() & block.flag) == 0) continue;
    if (const std::optional<bool> all = holds.read_all(block))
      recorder_.kept(
          Check::kBlockWhole, hold.ended, *all,
          [&block] { return flag_text(block) + ": cleared without having read all of the block"; },
          Act::written(block.command, hold.ended));
  }
}

void ServedBlocks::judge_flags(const UserHold& hold) {
  for (std::size_t i = kFirst; i < kChipBlocks.size(); ++i) {
    const Block& block = kChipBlocks.at(i);
    const FlagsInHold& flags = hold.chip(block);
    if (!flags.looked_at() && flags.taken == 0) continue;
    Duty& duty = flags_.at(i);
    if (((flags.before | flags.after | flags.taken) & block.flag) != 0)
      duty.begins(block.command == regs::kChipCommand1 ? intr0_.since().value_or(hold.began) : hold.began);
    if ((flags.after & block.flag) == 0)
      duty.met(recorder_, Check::kBlockServed, hold.ended, [&block] { return flag_text(block) + ": late"; });
  }
  const auto looked = [&hold](Duty& duty, const FlagsInHold& flags) {
    if ((flags.looked_at() || hold.told_news) && duty.since() && hold.began >= *duty.since()) duty.ends();
  };
  looked(intr0_, hold.chip_1);
  looked(request_, hold.chip_2);
}

/// A newer block does not renew the time: the master still waits.
void ServedBlocks::judge_verdicts(const UserHold& hold) {
  for (std::size_t kind = 0; kind < kJudgedBlocks.size(); ++kind) {
    const Block& block = kJudgedBlocks.at(kind).block;
    Duty& duty = verdicts_.at(kind);
    if ((hold.chip_1.fetched() & block.flag) != 0 && is_judged_by_user(kind)) duty.begins(hold.ended);
    if ((hold.user_1.set() & kJudgedBlocks.at(kind).verdict) != 0)
      duty.met(recorder_, Check::kVerdictGiven, hold.ended, [&block] { return std::string("on the ") + block.name; });
  }
}

void ServedBlocks::pass(Tick now) {
  intr0_.pass(
      recorder_, Check::kBlockServed, now, [] { return std::string("INTR0: the user has not looked at B00E"); });
  request_.pass(recorder_, Check::kBlockServed, now,
                [] { return std::string("a request on C1 or C2: the user has not looked at B00F"); });
  for (std::size_t i = kFirst; i < flags_.size(); ++i)
    flags_.at(i).pass(recorder_, Check::kBlockServed, now,
                      [i] { return flag_text(kChipBlocks.at(i)) + ": still set"; });
  for (std::size_t kind = 0; kind < kJudgedBlocks.size(); ++kind)
    verdicts_.at(kind).pass(recorder_, Check::kVerdictGiven, now,
                            [kind] { return std::string("no verdict on the ") + kJudgedBlocks.at(kind).block.name; });
}

}  // namespace dsdpv1::checks

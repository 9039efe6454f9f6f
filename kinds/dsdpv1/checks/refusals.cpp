#include "kinds/dsdpv1/checks/refusals.hpp"

#include <string>
#include <utility>

#include "model/dpram/reasons.hpp"
#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1::checks {
namespace {

/// The user may hand over inputs of the earlier length before it sees a new configuration.
constexpr unsigned kUnknowing = 2;

/// Blocks that no state of master or chip can make wrong.
constexpr bool is_of_block(profibus::Reason reason) {
  return reason == dpram::Reason::kInitLength || reason == dpram::Reason::kInitAddress ||
         reason == dpram::Reason::kInitLimit || reason == dpram::Reason::kInitCfg ||
         reason == profibus::Reason::kDiagLength || reason == profibus::Reason::kDiagType ||
         reason == dpram::Reason::kAcyclicLength || reason == dpram::Reason::kBeforeInit;
}

/// CRCs of blocks; over the parallel port CRC_WRITTEN judges them.
constexpr bool is_of_crc(profibus::Reason reason) {
  return reason == dpram::Reason::kInitCrc || reason == dpram::Reason::kInputCrc || reason == dpram::Reason::kDiagCrc ||
         reason == dpram::Reason::kC1Crc || reason == dpram::Reason::kC2Crc;
}

constexpr bool is_of_telegram(profibus::Reason reason) {
  return reason == Reason::kTelegramCrc || reason == Reason::kTelegramAddress || reason == Reason::kTelegramData ||
         reason == Reason::kTelegramLength;
}

}  // namespace

/// A verdict may come too late for its block (H7, S16); one without a block is wrong. A lost reply may have cleared a
/// flag that the user has never seen (UA11): it can only read the block once more.
void Refusals::hold(const UserHold& hold, const UserHolds& holds) {
  const std::uint8_t fetched = hold.chip_1.fetched();
  for (std::size_t kind = 0; kind < kJudgedBlocks.size(); ++kind) {
    const auto& [block, verdict] = kJudgedBlocks.at(kind);
    if ((fetched & block.flag) != 0 || (hold.what == HoldOf::kTelegram && holds.has_read_crc(block)))
      fetched_.at(kind) = true;
    if ((hold.user_1.set() & verdict) != 0) unfounded_.at(kind) = !std::exchange(fetched_.at(kind), false);
  }
  if (hold.initialises() || (fetched & regs::kChipCommand1Cfg) != 0) lengths_ = 0;
  if (hold.chip_1.looked_at() || hold.told_news) cfg_waits_ = (hold.chip_1.after & regs::kChipCommand1Cfg) != 0;
  if (told_ && (hold.user_1.set() | hold.user_2.set()) != 0)
    recorder_.kept(Check::kUserRefused, hold.ended, true, [] { return std::string(); });
}

/// More than the area holds is never right (D12). A configuration that the user has not fetched may have another
/// length, and over the UART it may hand over the empty inputs of the DPRAM to get news (UA10).
bool Refusals::is_wrong_length(unsigned length, Port port) {
  if (length > regs::kInputDataSize) return true;
  if (cfg_waits_ || (port == Port::kUart && length == 0)) return false;
  return ++lengths_ > kUnknowing;
}

/// Over the UART a newer request may come between the user's look and its answer.
bool Refusals::is_users_fault(const profibus::Event& event, Port port) {
  const profibus::Reason reason = event.reason;
  if (reason == profibus::Reason::kVerdictUnexpected) return unfounded_.at(event.a == 0 ? 0 : 1);
  if (reason == profibus::Reason::kInputLength) return is_wrong_length(event.a, port);
  if (reason == profibus::Reason::kAcyclicAnswerDiffers) return port != Port::kUart;
  return is_of_block(reason) || is_of_telegram(reason) || (is_of_crc(reason) && port != Port::kParallel);
}

/// The user's last write of the flags: with a block's flag it has handed over what is refused.
void Refusals::event(const profibus::Event& event, Port port) {
  told_ = true;
  if (!is_users_fault(event, port)) return;
  const bool acyclic = event.reason == dpram::Reason::kC1Crc || event.reason == dpram::Reason::kC2Crc ||
                       event.reason == dpram::Reason::kAcyclicLength ||
                       event.reason == profibus::Reason::kAcyclicAnswerDiffers;
  const Address flags = acyclic ? regs::kUserCommand2 : regs::kUserCommand1;
  recorder_.kept(
      Check::kUserRefused, event.at, false, [&event] { return dsdpv1::describe(event); },
      is_of_telegram(event.reason) ? Act::done(event.at) : Act::written(flags, event.at));
}

}  // namespace dsdpv1::checks

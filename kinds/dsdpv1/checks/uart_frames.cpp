#include "kinds/dsdpv1/checks/uart_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dsdpv1::checks {
namespace {

constexpr Tick kSynchroniser = 2 * kTicksPerCycle;  // P9

}  // namespace

UartFrames::UartFrames(Recorder& recorder, const SerialSettings& settings, UserDuties& duties)
    : recorder_(recorder), settings_(settings), accesses_(duties) {
  from_chip_.on_character = [this](const bus::ReceivedCharacter& each) { replied(each); };
}

/// Shows the margin in bit times beside that in ns.
void UartFrames::value(Check check, Tick at, Tick measured, const std::string& what) {
  recorder_.value(
      check, at, measured,
      [this, measured, &what] {
        return fmt::format("{}, {:.3f} bit times", what,
                           static_cast<double>(measured) / static_cast<double>(bit_ticks()));
      });
}

void UartFrames::reset(Tick at, bool in_reset) {
  advance(at);
  state_ = in_reset ? State::kOff : State::kWait;
  interval_cell_ = tsdr_cell_ = 0;
  stop_bit_.reset();
  free_.reset();
  from_chip_.reset(true);
  if (!in_reset) sampler_.restart(rxd_, 0, bit());
}

void UartFrames::pin(Tick at, Pin pin, Level level) {
  if (pin != Pin::kRxd && pin != Pin::kTxd) return;
  advance(at);
  if (pin == Pin::kRxd) return note_rxd(at, level != 0);
  from_chip_.line_changed(at, level != 0);
  if (level == 0) txd_fell(at);
}

/// A pulse between two edges of CLK is not a change (P9).
void UartFrames::note_rxd(Tick at, bool level) {
  if (level == (unseen_ ? unseen_->level : rxd_)) return;
  if (unseen_)
    unseen_.reset();
  else
    unseen_ = Edge{at, level};
}

void UartFrames::advance(Tick at) {
  from_chip_.run(at);
  if (unseen_ && edge_seeing(unseen_->at) * kTicksPerCycle <= at) {
    const Edge edge = *std::exchange(unseen_, std::nullopt);
    rxd(edge.at, edge.level);
  }
  if (state_ == State::kReply && reply_end_ && *reply_end_ < at) end_reply(*reply_end_);
  if (state_ == State::kOff || state_ == State::kReply) return;
  if (const auto complete = sampler_.advance(at)) character(*complete);
}

void UartFrames::rxd(Tick at, bool level) {
  rxd_ = level;
  if (stop_bit_ && stop_bit_->character.stop_ok != level) judge_stop(at);
  (level ? rxd_rose_ : rxd_fell_) = at;
  if (!level && free_) {
    value(Check::kRxdHalfDuplex, at, at - *free_, "after the reply");
    free_.reset();
  }
  if (state_ == State::kReply) {
    if (!level && !talked_) talked_ = at;
  } else if (state_ != State::kOff) {
    sampler_.change(at, level);
  }
}

// --- characters ------------------------------------------------------------------------------------------------------

void UartFrames::character(const RxdCharacter& character) {
  if (state_ == State::kIn && !in_time(character)) state_ = State::kWait;
  if (state_ == State::kDeaf && is_silence_over(character)) state_ = State::kWait;
  if (state_ == State::kDeaf) return follow(character);
  if (state_ == State::kWait) begin_telegram();
  hear(character);
}

void UartFrames::begin_telegram() {
  request_.clear();
  gap_ = settings_.silence(interval_cell_) * kBitsPerCharacter * bit() / 2;
}

bool UartFrames::in_time(const RxdCharacter& character) {
  const Tick late = silence_after(character.idle_since), left = late - 1 - character.fell;
  value(Check::kRxdCharacterGap, std::min(character.fell, late), left,
        fmt::format("character {} of the telegram", request_.size()));
  return left >= 0;
}

/// A character before the telegram's end, as far as that is known, belongs to the telegram.
bool UartFrames::is_silence_over(const RxdCharacter& character) {
  const Tick beyond = character.fell - silence_after(character.idle_since);
  if (beyond >= 0 || over_) value(Check::kRxdSilence, character.fell, beyond, "after a telegram that was spoilt");
  if (beyond < 0 && std::exchange(over_, false)) request_.clear();
  return beyond >= 0;
}

void UartFrames::hear(const RxdCharacter& character) {
  stop_bit_ = {character, rxd_rose_, request_.size()};
  if (character.stop_ok)
    recorder_.kept(Check::kRxdParity, character.stop, character.parity_ok, [this, &character] {
      return fmt::format("character {} of the telegram, {:02X}", request_.size(), character.value);
    });
  const bool right = character.stop_ok && character.parity_ok;
  state_ = right ? State::kIn : State::kDeaf;
  follow(character);
  if (right && !request_.begins()) state_ = State::kDeaf;
  if (right && over_) request_complete(character);
}

/// A break ends the telegram, complete or not.
void UartFrames::follow(const RxdCharacter& character) {
  request_.add(character.value);
  over_ = (character.low && !character.stop_ok) || (request_.begins() && request_.complete());
}

/// Measured to RXD's rise if early, to its next fall if late: no edge of RXD is near the sample.
void UartFrames::judge_stop(Tick next_edge) {
  const StopBit stop = *std::exchange(stop_bit_, std::nullopt);
  const RxdCharacter& character = stop.character;
  const Tick rose = character.stop_ok ? stop.rose : next_edge;
  Tick margin = character.stop - 1 - rose;
  if (character.stop_ok && !character.low) margin = std::min(margin, next_edge - character.stop);
  value(character.low ? Check::kRxdBreak : Check::kRxdFraming, character.stop, margin,
        fmt::format("character {} of the telegram, {:02X}", stop.number, character.value));
}

// --- telegrams -------------------------------------------------------------------------------------------------------

void UartFrames::request_complete(const RxdCharacter& last) {
  state_ = State::kWait;
  if (!settings_.is_own(request_.card())) return;
  state_ = State::kReply;
  asked_ = last.fell + kBitsPerCharacter * bit_ticks();
  from_chip_.set_bit(bit_ticks());
  reply_.clear();
  tsdr_ = std::max<Tick>(settings_.uart_min_tsdr, tsdr_cell_);
  reply_end_.reset();
  talked_.reset();
  note_registers();
}

/// The write takes effect: the UART refuses no valid telegram.
void UartFrames::note_registers() {
  if (request_.kind() != TelegramKind::kWrite || !request_.right()) return;
  interval_cell_ = request_.written(kUartIntervalCell).value_or(interval_cell_);
  tsdr_cell_ = request_.written(kUartTsdrCell).value_or(tsdr_cell_);
}

void UartFrames::txd_fell(Tick at) {
  if (state_ != State::kReply) return;
  if (!reply_end_) {
    value(Check::kTxdReplyEarly, at, at - asked_ - tsdr_ * bit_ticks(), fmt::format("after {} bit times", tsdr_));
    value(Check::kTxdReplyTime, at, at - asked_, "after the request");
  }
  if (!reply_end_ || at > *reply_end_ - bit_ticks() / 2) reply_end_ = at + kBitsPerCharacter * bit_ticks();
}

/// The last character's stop bit is sampled before the reply's end, so `request_` is still the one replied to.
void UartFrames::replied(const bus::ReceivedCharacter& character) {
  if (state_ != State::kReply || !request_.complete()) return;
  reply_.add(character.byte);
  if (reply_.complete(request_)) accesses_.replied(request_, reply_, asked_, character.end);
}

/// The chip receives a start bit that it sees after its last stop bit: one that comes after its synchroniser's delay.
void UartFrames::end_reply(Tick reply_end) {
  const Tick free = reply_end - kSynchroniser;
  if (talked_)
    value(Check::kRxdHalfDuplex, *talked_, *talked_ - free, "before the reply's end");
  else
    free_ = free;
  state_ = State::kWait;
  if (!rxd_ && rxd_fell_ >= free)
    sampler_.restart_with_start_bit(rxd_fell_, bit());
  else
    sampler_.restart(rxd_, free / kTicksPerCycle, bit());
}

// --- the end of the run ----------------------------------------------------------------------------------------------

void UartFrames::finish(Tick end) {
  advance(end + 1);
  if (stop_bit_) judge_stop(end);
  if (state_ == State::kIn && sampler_.idle_since() && silence_after(*sampler_.idle_since()) <= end) {
    const Tick late = silence_after(*sampler_.idle_since());
    value(Check::kRxdCharacterGap, late, late - 1 - end, "the telegram has no end");
  }
  if (state_ != State::kReply) return;
  if (talked_)
    value(Check::kRxdHalfDuplex, *talked_, *talked_ - std::max(end, reply_end_.value_or(end)), "the reply is not over");
  if (!reply_end_ && asked_ < end) value(Check::kTxdReplyTime, end, end - asked_, "no reply");
}

}  // namespace dsdpv1::checks

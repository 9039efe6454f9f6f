#include "tb/bench/answer_fault.hpp"

#include <algorithm>

namespace dsdpv1::tb {
namespace {

using bus::Tick;
using Kind = scenario::AnswerFaultKind;

constexpr std::uint8_t kWrongBit = 0x01;  ///< in a byte, by choice
constexpr std::uint8_t kExtended = 0x80;  ///< an address with an address extension: a SAP follows
constexpr int kParityBit = 9;             ///< of a character

/// The bits of a character that make its byte wrong by `bits`, with right parity.
std::uint16_t wrong_by(std::uint8_t bits) {
  std::uint16_t parity = 0;
  for (std::uint8_t rest = bits; rest != 0; rest = static_cast<std::uint8_t>(rest >> 1)) parity ^= rest & 1U;
  return static_cast<std::uint16_t>(bits << 1 | parity << kParityBit);
}

}  // namespace

void AnswerFault::damage(Tick now, Kind kind, int times, Tick late) {
  kind_ = kind;
  left_ = times;
  late_ = late;
  damages_ = false;
  enabled_ = segment_.divert(station_, now, *this);
  receiver_.on_character = [this](const bus::ReceivedCharacter& heard) { character(heard); };
}

Tick AnswerFault::next() const {
  Tick next = damages_ ? std::min(receiver_.next(), cut_at_) : bus::kNever;
  if (!toggles_.empty()) next = std::min(next, toggles_.front());
  return queue_.empty() ? next : std::min(next, queue_.front().at);
}

void AnswerFault::run(Tick now) {
  for (; !queue_.empty() && queue_.front().at <= now; queue_.pop_front()) pass_on(queue_.front());
  if (damages_ && receiver_.next() <= now) receiver_.run(now);
  if (apply(now)) emit(now);
  stop_if_done();
}

void AnswerFault::driven(Tick at, bool enabled, bool level) {
  announce();
  const bool ends = enabled_ && !enabled;
  if (enabled && !enabled_) begin(at);
  enabled_ = enabled;
  level_ = level;
  apply(at);
  if (damages_) {
    const bool first = bytes_.empty() && !receiver_.receiving();
    receiver_.line_changed(at, !enabled || level);
    if (first && receiver_.receiving()) plan(at, inverted_in(0));
    if (kind_ == Kind::kDoubled) copy_.push_back({at, enabled, level});
  }
  if (damages_ && kind_ == Kind::kLate)
    queue_.push_back({at + late_, enabled, level});
  else
    emit(at);
  if (ends) end(at);
}

/// One that begins while an earlier one is still on its way is lost.
void AnswerFault::begin(Tick at) {
  lost_ = !queue_.empty();
  damages_ = left_ > 0 && !lost_;
  effective_ = kind_ == Kind::kSilent || kind_ == Kind::kLate || kind_ == Kind::kDoubled;
  inverts_ = cut_ = false;
  cut_at_ = bus::kNever;
  began_ = at;
  receiver_.set_bit(bit_());
  receiver_.reset(true);
  bytes_.clear();
  toggles_.clear();
  copy_.clear();
}

void AnswerFault::end(Tick at) {
  for (const Edge& edge : copy_) queue_.push_back({edge.at - began_ + at, edge.enabled, edge.level});
  copy_.clear();
  toggles_.clear();
  inverts_ = lost_ = false;
  if (damages_ && effective_) --left_;
  damages_ = false;
  stop_if_done();
}

void AnswerFault::stop_if_done() {
  if (left_ == 0 && !enabled_ && queue_.empty()) segment_.end_diversion(station_);
}

void AnswerFault::pass_on(const Edge& edge) { segment_.deliver(station_, edge.at, edge.enabled, edge.level); }

void AnswerFault::emit(Tick at) {
  if (lost_ || (damages_ && (kind_ == Kind::kSilent || kind_ == Kind::kLate))) return;
  pass_on({at, enabled_ && !cut_, level_ != inverts_});
}

/// Applies changes up to `at`; true if the line changes.
bool AnswerFault::apply(Tick at) {
  const bool inverted = inverts_, was_cut = cut_;
  for (; !toggles_.empty() && toggles_.front() <= at; toggles_.pop_front()) inverts_ = !inverts_;
  if (cut_at_ <= at) {
    cut_ = true;
    cut_at_ = bus::kNever;
  }
  return inverts_ != inverted || cut_ != was_cut;
}

void AnswerFault::character(const bus::ReceivedCharacter& heard) {
  bytes_.push_back(heard.byte);
  plan(heard.end, inverted_in(bytes_.size()));
  if (kind_ == Kind::kCut && length() > 1 && bytes_.size() == length() / 2) {
    cut_at_ = heard.end;
    effective_ = true;
  }
}

void AnswerFault::plan(Tick start, std::uint16_t inverted) {
  if (inverted != 0) effective_ = true;
  bool before = false;
  for (int bit = 0; bit <= bus::kCharacterBits; ++bit) {
    const bool now = (inverted >> bit & 1U) != 0;
    if (now != before) toggles_.push_back(start + bit * bit_());
    before = now;
  }
}

/// The answer's; 0: not known yet, or of no length that has an end.
std::size_t AnswerFault::length() const {
  if (bytes_.empty()) return 0;
  if (bytes_[0] == bus::sd::k1) return 6;
  if (bytes_[0] == bus::sd::k3) return 14;
  return bytes_[0] == bus::sd::k2 && bytes_.size() > 1 ? bytes_[1] + 6U : 0;
}

/// The place of the address or SAP that the fault changes; 0: there is none.
std::size_t AnswerFault::wrong_byte() const {
  const std::size_t first = first_address();
  if (kind_ == Kind::kDa) return first;
  if (kind_ == Kind::kSa) return first + 1;
  if (kind_ != Kind::kSap || bytes_.size() < first + 2 || (bytes_[first + 1] & kExtended) == 0) return 0;
  return first + 3 + ((bytes_[first] & kExtended) != 0 ? 1 : 0);  // of the slave, after that of the master
}

std::uint16_t AnswerFault::inverted_in(std::size_t position) const {
  if (kind_ == Kind::kParity) return position == 0 ? 1U << kParityBit : 0;
  const std::size_t whole = length();
  if (whole == 0) return 0;
  if (kind_ == Kind::kEd) return position == whole - 1 ? wrong_by(kWrongBit) : 0;
  if (kind_ == Kind::kFcs) return position == whole - 2 ? wrong_by(kWrongBit) : 0;
  const std::size_t wrong = wrong_byte();
  if (wrong == 0) return 0;
  if (position == wrong) return wrong_by(kWrongBit);
  return position == whole - 2 ? corrected_fcs() : 0;
}

/// So that the changed telegram is right in itself.
std::uint16_t AnswerFault::corrected_fcs() const {
  unsigned right = 0, changed = 0;
  for (std::size_t i = first_address(); i < bytes_.size(); ++i) {
    right += bytes_[i];
    changed += i == wrong_byte() ? bytes_[i] ^ kWrongBit : bytes_[i];
  }
  return wrong_by(static_cast<std::uint8_t>(right ^ changed));
}

}  // namespace dsdpv1::tb

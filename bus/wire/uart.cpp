#include "bus/wire/uart.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::bus {

namespace {

constexpr std::int64_t kMillion = 1'000'000;
constexpr int kMillibits = 1000;
constexpr std::uint16_t kParityBit = 1U << 9;
constexpr std::uint16_t kStopBit = 1U << 10;

bool bit_of(std::uint16_t bits, int index) { return ((bits >> index) & 1U) != 0; }

Character broken_character(std::uint8_t byte, std::size_t index, const WireFaults& faults) {
  Character character = Character::of(byte);
  if (faults.wrong_parity_at == index) character.bits ^= kParityBit;
  if (faults.missing_stop_at == index) character.bits ^= kStopBit;
  if (faults.gap_before == index) character.gap_millibits = faults.gap_millibits;
  if (faults.glitch_at == index) character.glitch = faults.glitch;
  return character;
}

}  // namespace

Character Character::of(std::uint8_t byte) {
  Character character;
  character.bits = frame_of(byte);
  return character;
}

Character Character::wrong_parity(std::uint8_t byte) {
  Character character = of(byte);
  character.bits ^= kParityBit;
  return character;
}

Character Character::without_stop(std::uint8_t byte) {
  Character character = of(byte);
  character.bits ^= kStopBit;
  return character;
}

bool Character::right() const {
  return bits == frame_of(byte()) && bit_count == kCharacterBits && gap_millibits == 0 && !glitch;
}

std::vector<Character> characters(const Bytes& bytes, const WireFaults& faults) {
  std::vector<Character> result;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    Character character = broken_character(bytes[i], i, faults);
    if (faults.truncate_after == i) {
      character.bit_count = faults.truncate_bits;
      if (character.bit_count > 0) result.push_back(character);
      break;
    }
    result.push_back(character);
  }
  return result;
}

void UartSender::set_timing(Tick bit, std::int64_t ppm) {
  bit_ = bit;
  ppm_ = ppm;
}

void UartSender::set_driver_times(Tick lead, Tick trail) {
  lead_ = lead;
  trail_ = trail;
}

Tick UartSender::exact(std::int64_t millibits) const {
  const std::int64_t nominal = millibits * bit_;  // 1/1000 tick
  return (nominal + nominal * ppm_ / kMillion + kMillibits / 2) / kMillibits;
}

void UartSender::send(Tick start, const std::vector<Character>& characters) {
  run_.clear();
  const auto right = [](const Character& character) { return character.right(); };
  if (ppm_ == 0 && std::all_of(characters.begin(), characters.end(), right))
    for (const Character& character : characters) run_.push_back(character.byte());
  std::int64_t millibits = 0;
  for (const Character& each : characters) millibits += each.gap_millibits + each.bit_count * kMillibits;
  begin(start, millibits);
  if (run_state_ == Run::kNone) spell_out(characters);
}

void UartSender::send(Tick start, const Bytes& bytes) {
  if (ppm_ != 0) return send(start, characters(bytes));
  run_ = bytes;
  begin(start, static_cast<std::int64_t>(bytes.size()) * kCharacterBits * kMillibits);
}

/// The driver's edges around the bits, which are sent as a run if possible.
void UartSender::begin(Tick start, std::int64_t millibits) {
  run_state_ = run_.empty() ? Run::kNone : Run::kOffered;
  position_ = 0;
  start_ = start;
  end_ = start_ + exact(millibits);
  edges_.assign({{start - lead_, true, true}, {end_ + trail_, false, true}});
}

/// Inserts the characters' edges between the driver's.
void UartSender::spell_out(const std::vector<Character>& characters) {
  const Edge released = edges_.back();
  edges_.pop_back();
  std::int64_t millibits = 0;
  for (const Character& character : characters) {
    millibits += character.gap_millibits;
    add_character(millibits, character);
    millibits += character.bit_count * kMillibits;
  }
  add_level(end_, true);
  edges_.push_back(released);
}

void UartSender::spell_out_run() {
  run_state_ = Run::kNone;
  spell_out(characters(run_));
}

void UartSender::add_character(std::int64_t start_millibits, const Character& character) {
  const std::int64_t glitch_start = character.glitch ? character.glitch->start_millibits : -1;
  const std::int64_t glitch_end = character.glitch ? glitch_start + character.glitch->length_millibits : -1;
  std::vector<std::int64_t> instants;
  instants.reserve(static_cast<std::size_t>(character.bit_count) + 2);
  for (int i = 0; i < character.bit_count; ++i) instants.push_back(i * kMillibits);
  if (character.glitch) instants.insert(instants.end(), {glitch_start, glitch_end});
  std::sort(instants.begin(), instants.end());
  if (character.gap_millibits > 0) add_level(start_ + exact(start_millibits - character.gap_millibits), true);
  for (const std::int64_t instant : instants) {
    const int bit = static_cast<int>(instant / kMillibits);
    const bool inverted = instant >= glitch_start && instant < glitch_end;
    add_level(start_ + exact(start_millibits + instant),
              (bit >= character.bit_count || bit_of(character.bits, bit)) != inverted);
  }
}

void UartSender::add_level(Tick at, bool level) {
  if (edges_.back().level != level) edges_.push_back({at, true, level});
}

void UartSender::offer_run() {
  if (segment_.send_run(station_, {start_, bit_, run_.data(), run_.size()}))
    run_state_ = Run::kUnderWay;
  else
    spell_out_run();
}

void UartSender::run_cut(Tick at) {
  if (run_state_ != Run::kUnderWay) return;
  spell_out_run();
  const auto happened = [at](const Edge& edge) { return edge.at <= at; };
  position_ = static_cast<std::size_t>(std::find_if_not(edges_.begin(), edges_.end(), happened) - edges_.begin());
}

void UartSender::abort(Tick now) {
  if (!busy()) return;
  run_state_ = Run::kNone;
  edges_.clear();
  position_ = 0;
  end_ = now;
  segment_.drive(station_, now, false, true);
}

void UartSender::run(Tick now) {
  while (busy() && next() <= now) {
    if (offers_run()) {
      offer_run();
      continue;
    }
    const Edge edge = edges_[position_++];
    segment_.drive(station_, edge.at, edge.enabled, edge.level);
  }
}

void UartReceiver::reset(bool level) {
  in_run_ = false;
  receiving_ = false;
  level_ = level;
}

bool UartReceiver::line_changed(Tick at, bool level) {
  const Tick before = next();
  end_run(at);
  sample_until(at);
  level_ = level;
  if (!receiving_ && !level) begin(at);
  return next() != before;
}

void UartReceiver::begin(Tick at) {
  receiving_ = true;
  start_ = at;
  sampled_ = 0;
  bits_ = 0;
}

void UartReceiver::run(Tick now) {
  end_run(now + 1);
  sample_until(now + 1);
}

bool UartReceiver::set_run(const CharacterRun& run, bool each) {
  end_run(run.start);
  sample_until(run.start);
  if (receiving() || run.bit != bit_) return false;
  run_bytes_.assign(run.bytes, run.bytes + run.size);
  run_ = run;
  run_.bytes = run_bytes_.data();
  in_run_ = true;
  each_ = each;
  reported_ = 0;
  return true;
}

void UartReceiver::end_run(Tick before) {
  if (!in_run_ || next() >= before) return;
  in_run_ = complete_at(run_.size - 1) >= before;
  const bool whole = !in_run_ && reported_ == 0;
  if (!whole || !on_run || !on_run(run_)) report_run(before - 1);
}

/// Reports the characters complete at `until`.
void UartReceiver::report_run(Tick until) {
  while (reported_ < run_.size && complete_at(reported_) <= until) {
    const std::size_t index = reported_++;
    if (on_character) on_character({run_.bytes[index], run_.character(index), run_.character(index + 1), true, true});
  }
}

void UartReceiver::cut_run(Tick at) {
  if (!in_run_) return;
  in_run_ = false;
  report_run(at);
  level_ = true;
  for (Tick edge = run_.character(reported_); edge <= at; edge += bit_)
    if (run_.level(edge) != level_) line_changed(edge, !level_);
}

void UartReceiver::sample_until(Tick end) {
  while (receiving_ && sample_at(sampled_) < end) sample();
}

void UartReceiver::sample() {
  if (sampled_ == 0 && level_) {
    receiving_ = false;
    if (on_false_start) on_false_start(start_);
    return;
  }
  if (level_) bits_ = static_cast<std::uint16_t>(bits_ | (1U << sampled_));
  if (++sampled_ == kCharacterBits) finish();
}

void UartReceiver::finish() {
  receiving_ = false;
  ReceivedCharacter character;
  character.byte = static_cast<std::uint8_t>(bits_ >> 1);
  character.start = start_;
  character.end = start_ + kCharacterBits * bit_;
  character.parity_ok = even_parity(character.byte) == bit_of(bits_, 9);
  character.stop_ok = bit_of(bits_, 10);
  if (on_character) on_character(character);
}

}  // namespace dsdpv1::bus

#include "model/systemc/character_line.hpp"

#include <algorithm>

namespace dsdpv1::systemc {
namespace {

constexpr int kParityBit = 9;
constexpr int kStopBit = 10;

bool odd_ones(std::uint8_t data) {
  bool odd = false;
  for (; data != 0; data = static_cast<std::uint8_t>(data & (data - 1U))) odd = !odd;
  return odd;
}

bool bit_of(std::uint16_t frame, int index) { return ((frame >> index) & 1U) != 0; }

}  // namespace

std::uint16_t frame_of(std::uint8_t data, bool parity_ok, bool stop_ok) {
  const bool parity = odd_ones(data) == parity_ok;
  return static_cast<std::uint16_t>(data << 1 | int{parity} << kParityBit | int{stop_ok} << kStopBit);
}

void EdgeQueue::push(Edge edge) {
  while (!edges_.empty() && edges_.back().at >= edge.at) edges_.pop_back();
  edges_.push_back(edge);
}

void EdgeQueue::insert(Edge edge) {
  const auto later = [&edge](const Edge& other) { return other.at > edge.at; };
  edges_.insert(std::find_if(edges_.begin(), edges_.end(), later), edge);
}

Edge EdgeQueue::take() {
  const Edge edge = edges_.front();
  edges_.pop_front();
  return edge;
}

void CharacterCollector::edge(Tick at, bool level, Tick bit) {
  sample_until(at);
  level_ = level;
  if (running_ || level) return;
  running_ = true;
  sampled_ = 0;
  frame_ = 0;
  character_ = LineCharacter{};
  character_.start = at;
  character_.bit = bit;
}

std::optional<LineCharacter> CharacterCollector::take(Tick now) {
  if (!running_ || now < character_.end()) return std::nullopt;
  sample_until(now);
  running_ = false;
  character_.data = static_cast<std::uint8_t>(frame_ >> 1);
  character_.stop_ok = bit_of(frame_, kStopBit);
  character_.parity_ok = bit_of(frame_, kParityBit) == odd_ones(character_.data);
  return character_;
}

void CharacterCollector::sample_until(Tick now) {
  if (!running_) return;
  for (; sampled_ < profibus::kBitsPerCharacter && middle_of_next_bit() <= now; ++sampled_)
    if (level_) frame_ = static_cast<std::uint16_t>(frame_ | 1U << sampled_);
}

Tick CharacterCollector::middle_of_next_bit() const {
  return character_.start + sampled_ * character_.bit + character_.bit / 2;
}

}  // namespace dsdpv1::systemc

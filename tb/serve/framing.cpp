#include "tb/serve/framing.hpp"

#include <utility>

#include "bus/telegram/telegram.hpp"

namespace dsdpv1::tb::serve {
namespace {

/// 68 LE LEr 68: LE counts DA, SA, FC and the data, but not the header, FCS and ED.
Frame variable_frame(const std::uint8_t* bytes, std::size_t count) {
  constexpr std::size_t kLeast = 4, kMost = 249, kAround = 6;
  const auto wrong = [=](std::size_t at, std::uint8_t expected) { return count > at && bytes[at] != expected; };
  if (count < 2) return {};
  if (bytes[1] < kLeast || bytes[1] > kMost || wrong(2, bytes[1]) || wrong(3, bus::sd::k2)) return {false, 0};
  return {true, bytes[1] + kAround};
}

}  // namespace

Frame frame_of(const std::uint8_t* bytes, std::size_t count) {
  if (count == 0) return {};
  switch (bytes[0]) {
    case bus::sd::k1: return {true, 6};
    case bus::sd::k2: return variable_frame(bytes, count);
    case bus::sd::k3: return {true, 14};
    case bus::sd::k4: return {true, 3};
    case bus::sd::kSc: return {true, 1};
    default: return {false, 0};
  }
}

std::optional<MarkedBytes::Byte> MarkedBytes::take(std::uint8_t read) {
  constexpr std::uint8_t kMark = 0xFF;
  if (seen_ == 0 && read != kMark) return Byte{read, false};
  if (seen_ == 0 || (seen_ == 1 && read == 0)) {
    ++seen_;
    return std::nullopt;
  }
  return Byte{read, std::exchange(seen_, 0) == 2};
}

void Intake::take(const bus::Bytes& bytes, WallTime now, const std::vector<std::size_t>& wrong) {
  if (bytes.empty()) return;
  for (const std::size_t place : wrong) wrong_.push_back(bytes_.size() + place);
  if (bytes_.empty()) begun_ = now;
  bytes_.push(bytes);
  last_ = now;
}

std::optional<Taken> Intake::next(WallTime now) {
  if (bytes_.empty()) return std::nullopt;
  const Frame frame = frame_of(bytes_.data(), bytes_.size());
  // First check: complete bytes are a telegram, however late this is called.
  if (frame.length != 0 && bytes_.size() >= frame.length) return take_out(frame.length);
  if (!frame.telegram || now >= give_up_at()) return take_out(bytes_.size());
  return std::nullopt;
}

std::size_t Intake::missing() const {
  if (bytes_.empty()) return 0;
  const Frame frame = frame_of(bytes_.data(), bytes_.size());
  return frame.length > bytes_.size() ? frame.length - bytes_.size() : 1;
}

Taken Intake::take_out(std::size_t count) {
  begun_ = last_;  // of the next telegram
  Taken taken{bytes_.take(count)};
  if (!wrong_.empty() && wrong_.front() < count) taken.wrong_at = wrong_.front();
  while (!wrong_.empty() && wrong_.front() < count) wrong_.pop_front();
  for (std::size_t& place : wrong_) place -= count;
  return taken;
}

}  // namespace dsdpv1::tb::serve

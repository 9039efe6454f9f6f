#include "tb/serve/framing.hpp"

#include "bus/telegram.hpp"

namespace tb::serve {
namespace {

/// 68 LE LEr 68: LE counts DA, SA, FC and the data; the header, FCS and ED come on top.
Frame variable_frame(const bus::Bytes& bytes) {
  constexpr std::size_t kLeast = 4, kMost = 249, kAround = 6;
  const auto wrong = [&bytes](std::size_t at, std::uint8_t expected) {
    return bytes.size() > at && bytes[at] != expected;
  };
  if (bytes.size() < 2) return {};
  if (bytes[1] < kLeast || bytes[1] > kMost || wrong(2, bytes[1]) || wrong(3, bus::sd::k2)) return {false, 0};
  return {true, bytes[1] + kAround};
}

}  // namespace

Frame frame_of(const bus::Bytes& bytes) {
  if (bytes.empty()) return {};
  switch (bytes.front()) {
    case bus::sd::k1: return {true, 6};
    case bus::sd::k2: return variable_frame(bytes);
    case bus::sd::k3: return {true, 14};
    case bus::sd::k4: return {true, 3};
    case bus::sd::kSc: return {true, 1};
    default: return {false, 0};
  }
}

void Intake::take(const bus::Bytes& bytes, WallTime now) {
  if (bytes.empty()) return;
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  last_ = now;
}

std::optional<bus::Bytes> Intake::next(WallTime now) {
  if (bytes_.empty()) return std::nullopt;
  const Frame frame = frame_of(bytes_);
  // First of all: what is complete is a telegram of its own, however late this is called.
  if (frame.length != 0 && bytes_.size() >= frame.length) return take_out(frame.length);
  if (!frame.telegram || now >= give_up_at()) return take_out(bytes_.size());
  return std::nullopt;
}

bus::Bytes Intake::take_out(std::size_t count) {
  const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(count);
  bus::Bytes taken(bytes_.begin(), end);
  bytes_.erase(bytes_.begin(), end);
  return taken;
}

}  // namespace tb::serve

#include "cosim/history.hpp"

#include <algorithm>
#include <iterator>

#include "io/waves/wave_writer.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr std::array<const char*, kSides> kScopes = {"inputs", "model", "rtl"};

bool belongs(std::size_t side, const tb::PinInfo& pin) {
  return pin.input == (static_cast<Side>(side) == Side::kInput);
}

}  // namespace

const char* name(Side side) { return kScopes.at(static_cast<std::size_t>(side)); }

void History::add(Tick at, Side side, PinNumber pin, Level level) {
  changes_.push_back({at, side, pin, level});
  forget_before(at - span_);
  if (pin == line_pin_) line_.add(at, level != 0);
}

void History::forget_before(Tick oldest) {
  for (; !changes_.empty() && changes_.front().at < oldest; changes_.pop_front()) {
    const Change& change = changes_.front();
    begin(change.side, change.pin, change.level);
  }
}

void History::write_wave(const std::string& path, Tick end) const {
  const std::unique_ptr<tb::WaveWriter> writer = tb::open_wave(path);
  std::array<std::array<tb::WaveWriter::Signal, kMostPins>, kSides> signals{};
  for (std::size_t side = 0; side < kSides; ++side) {
    writer->open_scope(kScopes.at(side));
    for (std::size_t i = 0; i < pins_.size(); ++i)
      if (belongs(side, pins_[i])) signals.at(side).at(i) = writer->wire(pins_[i].name, pins_[i].width);
    writer->close_scope();
  }
  const Tick begin = std::max<Tick>(0, changes_.empty() ? 0 : std::min(changes_.front().at, end - span_));
  for (std::size_t side = 0; side < kSides; ++side) {
    for (std::size_t i = 0; i < pins_.size(); ++i)
      if (belongs(side, pins_[i])) writer->set(begin, signals.at(side).at(i), levels_.at(side).at(i));
  }
  // Each side reports its changes in order of time, one side after the other.
  std::vector<Change> ordered(changes_.begin(), changes_.end());
  std::stable_sort(ordered.begin(), ordered.end(), [](const Change& a, const Change& b) { return a.at < b.at; });
  for (const Change& change : ordered)
    writer->set(std::max(begin, change.at), signals.at(static_cast<std::size_t>(change.side)).at(change.pin),
                change.level);
  writer->finish(std::max(end, begin));
}

}  // namespace dsdpv1::cosim

#include "lab/compare/side.hpp"

#include <fmt/format.h>

#include "io/input/input_error.hpp"

namespace dsdpv1::tb::compare {
namespace {

constexpr std::uint32_t kNone = UINT32_MAX;

char inverse(char level) { return level == '0' ? '1' : level == '1' ? '0' : level; }

std::string initial(const WaveSignal& signal) {
  return signal.kind == WaveKind::kBits ? std::string(signal.width, 'x') : std::string();
}

}  // namespace

Side::Side(const std::string& path, const std::string& scope)
    : path_(path),
      scope_(scope),
      reader_(read_wave(path)),
      nets_(reader_->declarations(), scope, path),
      place_(reader_->declarations().signals.size(), kNone) {}

std::vector<std::uint32_t> Side::places(const Net& net, Touched& list, std::uint32_t which) {
  std::vector<std::uint32_t> places;
  for (const std::uint32_t signal : net.signals) {
    std::uint32_t& place = place_[signal];
    if (place == kNone) {
      place = static_cast<std::uint32_t>(values_.size());
      values_.push_back(initial(reader_->declarations().signals[signal]));
      users_.emplace_back();
    }
    users_[place].push_back({&list, which});
    places.push_back(place);
  }
  return places;
}

Probe Side::watch(const Source& source, Touched& list, std::uint32_t which) {
  Probe probe;
  probe.pieces = places(source.net, list, which);
  probe.width = source.net.width;
  probe.inverted = source.inverted;
  if (!source.driven) return probe;
  probe.driven = places(*source.driven, list, which);
  probe.driven_low = source.driven_low;
  if (source.released) probe.released = places(*source.released, list, which);
  return probe;
}

void Side::start(const Scale& scale, Time shift) {
  scale_ = scale;
  shift_ = shift;
  std::vector<bool> selected;
  for (const std::uint32_t place : place_) selected.push_back(place != kNone);
  reader_->select(selected);
  fetch();
}

void Side::fetch() {
  have_ = reader_->next(event_);
  if (have_) next_ = at(event_.time);
}

Time Side::at(std::uint64_t time) const {
  const std::optional<Time> own = scale_.from(time, exponent());
  if (!own) throw InputError(path_, 0, fmt::format("has the time {}, which is beyond what can be compared", time));
  return *own + shift_;
}

void Side::take() {
  if (event_.kind == WaveEvent::Kind::kChange) {
    const std::uint32_t place = place_[event_.signal];
    values_[place].assign(event_.value);
    for (const User& user : users_[place]) user.list->add(user.which);
  } else {
    off_ = event_.kind == WaveEvent::Kind::kOff;
  }
  fetch();
}

void Side::put_together(const std::vector<std::uint32_t>& pieces) {
  scratch_.clear();
  for (const std::uint32_t place : pieces) scratch_ += values_[place];
}

std::string_view Side::value(const Probe& probe) {
  const bool split = !probe.driven.empty(),
             driven = split && values_[probe.driven[0]] == (probe.driven_low ? "0" : "1");
  if (split && !driven && probe.released.empty()) return scratch_.assign(probe.width, 'z');
  const std::vector<std::uint32_t>& pieces = split && !driven ? probe.released : probe.pieces;
  if (pieces.size() == 1 && !probe.inverted) return values_[pieces[0]];
  put_together(pieces);
  if (probe.inverted)
    for (char& c : scratch_) c = inverse(c);
  return scratch_;
}

}  // namespace dsdpv1::tb::compare

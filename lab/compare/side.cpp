#include "lab/compare/side.hpp"

#include <fmt/format.h>

#include "io/input/input_error.hpp"

namespace dsdpv1::tb::compare {
namespace {

constexpr std::uint32_t kNone = UINT32_MAX;

char inverse(char level) { return level == '0' ? '1' : level == '1' ? '0' : level; }

std::string initial(const WaveSignal& signal) {
  if (signal.kind == WaveKind::kEvent) return "0";
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
      moments_.push_back(0);
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
  switch (event_.kind) {
    case WaveEvent::Kind::kChange: set(place_[event_.signal], event_.value); break;
    case WaveEvent::Kind::kTrigger: {
      const std::uint32_t place = place_[event_.signal];
      set(place, std::to_string(++moments_[place]));
      break;
    }
    case WaveEvent::Kind::kOff: off_ = true; break;
    case WaveEvent::Kind::kOn: off_ = false; break;
  }
  fetch();
}

void Side::set(std::uint32_t place, std::string_view value) {
  values_[place].assign(value);
  for (const User& user : users_[place]) user.list->add(user.which);
}

void Side::restart_events() {
  for (std::size_t signal = 0; signal < place_.size(); ++signal)
    if (place_[signal] != kNone && reader_->declarations().signals[signal].kind == WaveKind::kEvent) {
      moments_[place_[signal]] = 0;
      set(place_[signal], "0");
    }
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

#include "lab/calibrate/wires.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "bus/capture/captured_telegram.hpp"
#include "io/input/suggest.hpp"

namespace dsdpv1::calibrate {
namespace {

using bus::capture::CaptureError;

std::size_t place_of(Wire wire) { return static_cast<std::size_t>(wire); }

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string leaf(const std::string& signal) { return lower(signal.substr(signal.rfind('.') + 1)); }

bool in_scope(const std::string& signal, const std::string& scope) {
  return scope.empty() || signal.compare(0, scope.size() + 1, scope + ".") == 0;
}

/// The names of a signal: "l_sta", rtl_ref's "l_sta_o", bits "a3", "a[3]", "a_i[3]".
std::vector<std::string> spellings(const WireInfo& wire) {
  if (wire.bus.empty()) {
    const std::string pin = lower(wire.name);
    return {pin, pin + "_i", pin + "_o"};
  }
  const std::string bus = lower(wire.bus), bit = std::to_string(wire.bit);
  return {bus + bit, bus + "[" + bit + "]", bus + "_i[" + bit + "]"};
}

std::vector<std::string> first_of(std::vector<std::string> names) {
  constexpr std::size_t kMost = 20;
  if (names.size() > kMost) names.resize(kMost);
  return names;
}

}  // namespace

std::vector<Wire> wires_of(const WireTable& table, const std::string& group) {
  std::vector<Wire> wires;
  for (std::size_t i = 0; i < table.size(); ++i)
    if (table[i].group != nullptr && table[i].group == group) wires.push_back(static_cast<Wire>(i));
  return wires;
}

std::size_t Trace::count_until(Tick at) const {
  return static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), at) - edges.begin());
}

bool Trace::low(Tick from, Tick to) const {
  const std::size_t count = count_until(from);
  return seen && !level(count) && count == count_until(to);
}

bool Trace::high(Tick from, Tick to) const {
  const std::size_t count = count_until(from);
  return seen && level(count) && count == count_until(to);
}

std::size_t Trace::next(Tick from, bool to_level) const {
  auto edge = static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), from) - edges.begin());
  if (level(edge + 1) != to_level) ++edge;
  return edge < edges.size() ? edge : kNone;
}

std::size_t Trace::last(Tick until, bool to_level) const {
  std::size_t count = count_until(until);
  if (count > 0 && level(count) != to_level) --count;
  return count == 0 ? kNone : count - 1;
}

bool Record::sees(const std::vector<Wire>& wires) const {
  return std::all_of(
      wires.begin(), wires.end(), [this](Wire wire) { return sees(wire); });
}

std::uint32_t Record::number(Wire first, std::size_t count, Tick at) const {
  std::uint32_t value = 0;
  for (std::size_t bit = 0; bit < count; ++bit) value |= (traces.at(place_of(first) + bit).at(at) ? 1U : 0U) << bit;
  return value;
}

std::vector<std::size_t> RecordTaker::choose(const std::vector<std::string>& signals) {
  for (std::size_t place = 0; place < table_.size(); ++place) look_for(static_cast<Wire>(place), signals);
  leave_out_lone_data();
  if (shows_nothing())
    throw CaptureError("shows no pin of the chip, its signals are " + tb::join(first_of(signals)) +
                       "; expected the names of table 1, or --signal PIN=NAME");
  return places_;
}

/// Any chip has a RESET, so that pin alone is of another one.
bool RecordTaker::shows_nothing() const {
  return std::all_of(
      chosen_.begin(), chosen_.end(),
      [this](const Chosen& each) { return std::string_view(table_.at(place_of(each.wire)).name) == "RESET"; });
}

void RecordTaker::look_for(Wire wire, const std::vector<std::string>& signals) {
  const WireInfo& info = table_[place_of(wire)];
  std::size_t found = Trace::kNone;
  bool inverted = false;
  const auto single = names_.given.find(info.name), vector = names_.given.find(info.bus);
  if (single != names_.given.end()) {
    found = given_place(info, single->second, "", signals);
    inverted = single->second.inverted;
  } else if (!info.bus.empty() && vector != names_.given.end()) {
    found = given_place(info, vector->second, "[" + std::to_string(info.bit) + "]", signals);
    inverted = vector->second.inverted;
  } else if (!names_.only_given) {
    found = named_place(info, signals);
  }
  if (found == Trace::kNone) return;
  places_.push_back(found);
  chosen_.push_back({wire, inverted});
  record_.traces.at(place_of(wire)).seen = true;
  record_.names.at(place_of(wire)) = signals[found];
}

std::size_t RecordTaker::given_place(const WireInfo& wire, const Names::Given& given, const std::string& suffix,
                                     const std::vector<std::string>& signals) const {
  const std::string wanted = given.signal + suffix;
  std::size_t found = Trace::kNone;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const std::string& signal = signals[i];
    const bool end = signal.size() > wanted.size() &&
                     signal.compare(signal.size() - wanted.size() - 1, std::string::npos, "." + wanted) == 0;
    if (signal == wanted) return i;
    if (!end || !in_scope(signal, names_.scope)) continue;
    if (found != Trace::kNone)
      throw CaptureError(
          fmt::format("{} for {} means {} and {}, expected one of them", wanted, wire.name, signals[found], signal));
    found = i;
  }
  if (found == Trace::kNone)
    throw CaptureError(fmt::format("has no signal {} for {}{}, expected {}", wanted, wire.name,
                                   tb::did_you_mean(wanted, signals), tb::join(first_of(signals))));
  return found;
}

std::size_t RecordTaker::named_place(const WireInfo& wire, const std::vector<std::string>& signals) const {
  const std::vector<std::string> allowed = spellings(wire);
  std::size_t found = Trace::kNone;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const bool right = std::find(allowed.begin(), allowed.end(), leaf(signals[i])) != allowed.end();
    if (!right || !in_scope(signals[i], names_.scope)) continue;
    if (found != Trace::kNone)
      throw CaptureError(fmt::format("has {} twice, as {} and {}, expected one: --scope or --signal {}=NAME", wire.name,
                                     signals[found], signals[i], wire.name));
    found = i;
  }
  return found;
}

/// Logic analysers also call their channels D0 to D7.
void RecordTaker::leave_out_lone_data() {
  const auto is_data = [this](const Chosen& chosen) { return table_[place_of(chosen.wire)].bus == "D"; };
  const auto is_of_port = [&](const Chosen& chosen) {
    return table_[place_of(chosen.wire)].group != nullptr && !is_data(chosen);
  };
  if (std::any_of(chosen_.begin(), chosen_.end(), is_of_port)) return;
  for (std::size_t i = chosen_.size(); i-- > 0;) {
    const std::size_t place = place_of(chosen_[i].wire);
    const bool given = names_.given.count(table_[place].name) != 0 || names_.given.count("D") != 0;
    if (!is_data(chosen_[i]) || given) continue;
    record_.traces.at(place).seen = false;
    chosen_.erase(chosen_.begin() + static_cast<std::ptrdiff_t>(i));
    places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

void RecordTaker::level(Tick at, std::size_t which, bool level) {
  const Chosen& chosen = chosen_[which];
  Trace& trace = record_.traces.at(place_of(chosen.wire));
  const bool now = level != chosen.inverted;
  if (!begun_.at(place_of(chosen.wire))) {
    trace.first = now;
    begun_.at(place_of(chosen.wire)) = true;
    return;
  }
  if (trace.level(trace.edges.size()) == now) return;
  if (!trace.edges.empty() && trace.edges.back() == at) {
    trace.edges.pop_back();  // changed back at the same tick: not visible
    return;
  }
  trace.edges.push_back(at);
  if (++changes_ > kMostChanges)
    throw CaptureError(
        fmt::format("has more than {} million changes, expected at most as many", kMostChanges / 1'000'000));
}

}  // namespace dsdpv1::calibrate

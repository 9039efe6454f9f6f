#include "cosim/random/recorded_stimulus.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "bus/baud.hpp"
#include "cosim/random/random_cases.hpp"

namespace dsdpv1::cosim {
namespace {

enum class LaneOf : std::uint8_t { kLine, kUser, kBoard };

/// Actions of one lane that belong together.
struct Piece {
  struct Timed {
    Tick at, end;
    Action action;
  };
  LaneOf lane;
  std::vector<Timed> actions;

  Tick at() const { return actions.front().at; }
};

Action action_of(Verb verb) {
  Action action;
  action.verb = verb;
  return action;
}

// --- the line --------------------------------------------------------------------------------------------------------

/// Reads the changes of the line: whole characters, else single low pulses.
class LineOf {
 public:
  /// `edges` alternate, and begin with a fall.
  LineOf(std::vector<InputChange> edges, Tick end) : edges_(std::move(edges)), end_(end) {}

  std::vector<Piece> pieces() {
    std::vector<Piece> all;
    for (std::size_t edge = 0; edge < edges_.size();) all.push_back({LaneOf::kLine, {next(edge)}});
    return all;
  }

 private:
  struct Run {
    bus::Bytes bytes;
    std::size_t edge;  ///< after it
  };
  /// The last rate first, then from the slowest on: at a slow rate fast characters never fit.
  Piece::Timed next(std::size_t& edge) {
    const Tick at = edges_[edge].at;
    for (int i = -1, rates = static_cast<int>(bus::kBauds.size()); i < rates; ++i) {
      const int rate = i < 0 ? rate_ : rates - 1 - i;
      Run run = characters(edge, bus::baud(rate).bit);
      if (run.bytes.empty()) continue;
      rate_ = rate;
      edge = run.edge;
      Action action = action_of(Verb::kSend);
      action.rate = rate;
      action.bytes = std::move(run.bytes);
      const Tick length = static_cast<Tick>(action.bytes.size()) * bus::kCharacterBits * bus::baud(rate).bit;
      return {at, at + length, std::move(action)};
    }
    Action action = action_of(Verb::kSpike);
    const Tick rise = edge + 1 < edges_.size() ? edges_[edge + 1].at : end_ + 1;
    action.low = rise - at;
    edge += 2;
    return {at, rise, std::move(action)};
  }
  /// Those without a gap from this fall on.
  Run characters(std::size_t edge, Tick bit) const {
    Run run{{}, edge};
    for (Tick at = edges_[edge].at; run.edge < edges_.size() && edges_[run.edge].at == at;
         at += bus::kCharacterBits * bit) {
      const std::optional<std::uint8_t> byte = character(run.edge, bit);
      if (!byte) break;
      run.bytes.push_back(*byte);
    }
    return run;
  }
  /// A right one that begins with this fall; `edge` is then after it.
  std::optional<std::uint8_t> character(std::size_t& edge, Tick bit) const {
    const Tick at = edges_[edge].at, over = at + bus::kCharacterBits * bit;
    std::size_t next = edge;
    unsigned bits = 0;
    Level level = 1;
    for (int i = 0; i < bus::kCharacterBits; ++i) {
      const Tick begin = at + i * bit;
      if (next < edges_.size() && edges_[next].at == begin) level = edges_[next++].level;
      if (next < edges_.size() && edges_[next].at < std::min(begin + bit, over)) return std::nullopt;
      bits |= static_cast<unsigned>(level) << static_cast<unsigned>(i);
    }
    const bus::Character read{static_cast<std::uint16_t>(bits)};
    if (!read.right()) return std::nullopt;
    edge = next;
    return read.byte();
  }

  std::vector<InputChange> edges_;
  Tick end_;
  int rate_ = 0;
};

// --- user and board --------------------------------------------------------------------------------------------------

/// Joins the edges of an access: while a pin is low that selects the chip, at one tick, or of a serial character.
class UserOf {
 public:
  UserOf(const std::vector<InputChange>& edges, tb::PinMask selects) : edges_(edges), selects_(selects) {
    pulses_.fill(bus::kNever);
    for (std::size_t i = 1; i < edges.size(); ++i)
      if (is_pulse(i)) shortest(i) = std::min(shortest(i), gap(i));
  }

  std::vector<Piece> pieces() {
    std::vector<Piece> all;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const InputChange& edge = edges_[i];
      const bool joined = i > 0 && goes_on(i);
      if (!joined) all.push_back({LaneOf::kUser, {}});
      Action action = action_of(Verb::kPin);
      action.pin = edge.pin;
      action.value = edge.level;
      action.joined = joined;
      all.back().actions.push_back({edge.at, edge.at, std::move(action)});
      if ((selects_ & tb::mask_of(edge.pin)) == 0) continue;
      low_ = edge.level == 0 ? low_ | tb::mask_of(edge.pin) : low_ & ~tb::mask_of(edge.pin);
    }
    return all;
  }

 private:
  Tick gap(std::size_t i) const { return edges_[i].at - edges_[i - 1].at; }
  bool is_pulse(std::size_t i) const { return edges_[i].pin == edges_[i - 1].pin && gap(i) > 0; }
  Tick& shortest(std::size_t i) { return pulses_.at(edges_[i].pin); }
  bool goes_on(std::size_t i) {
    return low_ != 0 || gap(i) == 0 || (is_pulse(i) && gap(i) <= 2 * bus::kCharacterBits * shortest(i));
  }

  const std::vector<InputChange>& edges_;
  const tb::PinMask selects_;
  tb::PinMask low_ = 0;
  std::array<Tick, kMostPins> pulses_{};  ///< by pin
};

std::vector<Piece> resets_of(const std::vector<InputChange>& edges, Tick end) {
  std::vector<Piece> all;
  Tick fall = 0;
  bool low = true;
  const auto add = [&](Tick rise) {
    Action action = action_of(Verb::kReset);
    action.low = std::max<Tick>(1, rise - fall);
    all.push_back({LaneOf::kBoard, {{fall, fall + action.low, std::move(action)}}});
  };
  for (const InputChange& edge : edges) {
    if (edge.level != 0 && low) add(edge.at);
    low = edge.level == 0;
    fall = edge.at;
  }
  if (low && !edges.empty()) add(end + 1);
  return all;
}

/// The chip is played up to here, also while it alone acts.
Action stay(PinNumber reset) {
  Action action = action_of(Verb::kPin);
  action.pin = reset;
  action.value = 1;
  return action;
}

// --- all -------------------------------------------------------------------------------------------------------------

/// Puts the pieces in order of time. The lanes meet before a telegram, unless one of them is busy then, so that
/// leaving out an action moves nothing after it.
Stimulus in_order(std::vector<Piece> pieces) {
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.at() < b.at(); });
  Stimulus stimulus = {action_of(Verb::kAlone)};
  std::array<Tick, 3> ends{};
  bool met = true;
  for (Piece& piece : pieces) {
    const Tick meeting = *std::max_element(ends.begin(), ends.end());
    if (piece.lane == LaneOf::kLine && !met && meeting <= piece.at()) {
      stimulus.push_back(action_of(Verb::kSync));
      ends.fill(meeting);
      met = true;
    }
    met = met && piece.lane == LaneOf::kLine;
    Tick& lane = ends.at(static_cast<std::size_t>(piece.lane));
    for (Piece::Timed& each : piece.actions) {
      each.action.delay = each.at - std::exchange(lane, each.end);
      stimulus.push_back(std::move(each.action));
    }
  }
  return stimulus;
}

}  // namespace

Stimulus recorded_stimulus(const std::vector<InputChange>& inputs, Tick end, const tb::ChipKind& kind) {
  const tb::BoardPins& places = kind.board_pins();
  std::vector<InputChange> line, user, board;
  for (const InputChange& each : inputs)
    if (each.at > end)
      break;
    else if (each.pin != places.rxd)
      (each.pin == places.reset ? board : user).push_back(each);
    else if (!line.empty() || each.level == 0)
      line.push_back(each);
  std::vector<Piece> pieces = resets_of(board, end);
  for (Piece& each : UserOf(user, kind.random()->words().selects).pieces()) pieces.push_back(std::move(each));
  for (Piece& each : LineOf(std::move(line), end).pieces()) pieces.push_back(std::move(each));
  pieces.push_back({LaneOf::kUser, {{end, end, stay(places.reset)}}});
  return in_order(std::move(pieces));
}

}  // namespace dsdpv1::cosim

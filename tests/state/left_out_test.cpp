// Leaves out each field of a state: a chip restored without it, whose field then has its initial value, must differ at
// some moment from the one with it. fields.tsv lists all fields, and why some can be left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <utility>

#include "model/dsdpv1/chip_state.hpp"
#include "model/dsdpv1/reasons.hpp"
#include "registers/dsdpv1_regs.hpp"
#include "tests/state/life.hpp"

namespace dsdpv1::state_test {
namespace {

using State = std::vector<std::uint8_t>;
using profibus::StateField;
using profibus::StateWriter;

/// A line of fields.tsv.
struct Row {
  StateField field;
  std::string name, reason;  ///< why no test can detect its absence; empty: a test does
};

std::vector<Row> rows() {
  std::ifstream file(DSDPV1_SOURCE_DIR "/tests/state/fields.tsv");
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    Row row{};
    words >> row.field.at >> row.field.size >> row.name >> std::ws;
    std::getline(words, row.reason);
    rows.push_back(row);
  }
  return rows;
}

/// The bytes of the marks for unknown RAM contents are one field.
std::vector<StateField> fields_of_a_state() {
  static_cast<void>(Chip().save());
  std::vector<StateField> fields;
  std::size_t cells_end = 0;
  for (const StateField& each : StateWriter::fields()) {
    const bool is_mark = cells_end != 0 && each.at > cells_end && each.at < cells_end + regs::kDpramSize / 8;
    if (is_mark)
      fields.back().size += each.size;
    else
      fields.push_back(each);
    if (each.size == regs::kDpramSize) cells_end = each.at + each.size;
  }
  return fields;
}

TEST(StateFields, HaveTheirRowsInTheirOrder) {
  const std::vector<Row> known = rows();
  const std::vector<StateField> fields = fields_of_a_state();
  for (std::size_t i = 0; i < std::min(known.size(), fields.size()); ++i)
    ASSERT_TRUE(known[i].field.at == fields[i].at && known[i].field.size == fields[i].size)
        << known[i].name << " is " << fields[i].size << " bytes from " << fields[i].at;
  EXPECT_EQ(known.size(), fields.size());
}

/// The outcome of a chip from a state on; none when refused.
struct Seen {
  Heard heard;
  std::string at_once, at_the_end;

  bool operator==(const Seen& other) const {
    return heard == other.heard && at_once == other.at_once && at_the_end == other.at_the_end;
  }
};
using Rest = std::function<void(Chip& chip)>;
std::optional<Seen> goes_on(const State& state, const Config& config, Way way, const Rest& rest) {
  Seen seen;
  const auto chip = make_chip(config, way, seen.heard);
  try {
    chip->restore(state.data(), state.size());
  } catch (const StateError&) {
    return std::nullopt;
  }
  seen.at_once = asked(*chip, config, way);
  rest(*chip);
  seen.at_the_end = asked(*chip, config, way);
  return seen;
}

class Search {
 public:
  void look(const Aimed& aimed, Way way, Tick length) {
    const Recorded& slave = aimed.stimulus;
    Heard heard;
    const auto chip = make_chip(slave.config, way, heard);
    std::size_t inputs = 0;
    for (const Moment& moment : aimed.moments) {
      for (; inputs < moment.inputs; ++inputs)
        chip->set(slave.inputs[inputs].at, slave.inputs[inputs].pin, slave.inputs[inputs].level);
      chip->advance(moment.at);
      const Tick until = std::min(slave.end, moment.at + length);
      look(chip->save(), slave.config, way, [&](Chip& other) { play(other, slave, inputs, until); });
    }
  }
  void look(const Act& act) {
    Heard heard;
    const auto chip = make_chip(act.config, Way::kDoze, heard);
    act.before(*chip);
    look(chip->save(), act.config, Way::kDoze, act.rest);
  }

  void expect_all() const {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      EXPECT_TRUE(found_[i] || !rows_[i].reason.empty()) << rows_[i].name << " can be left out, and nothing finds it";
      EXPECT_TRUE(!found_[i] || rows_[i].reason.empty()) << rows_[i].name << " is found, in spite of its reason";
    }
  }

 private:
  void look(const State& state, const Config& config, Way way, const Rest& rest) {
    Heard none;
    const State fresh = make_chip(config, way, none)->save();
    // fields that should have no effect are tried less often
    constexpr unsigned kSeldom = 10;
    const bool all = ++moments_ % kSeldom == 0;
    std::optional<Seen> right;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (found_[i] || (!all && !rows_[i].reason.empty())) continue;
      const auto begin = static_cast<std::ptrdiff_t>(rows_[i].field.at);
      const auto end = begin + static_cast<std::ptrdiff_t>(rows_[i].field.size);
      if (std::equal(state.begin() + begin, state.begin() + end, fresh.begin() + begin)) continue;
      State without = state;
      std::copy(fresh.begin() + begin, fresh.begin() + end, without.begin() + begin);
      if (!right) right = goes_on(state, config, way, rest);
      found_[i] = !(goes_on(profibus::end_frame(without), config, way, rest) == right);
    }
  }

  const std::vector<Row> rows_ = rows();
  std::vector<bool> found_ = std::vector<bool>(rows_.size());
  unsigned moments_ = 0;
};

/// At and soon after the first two occurrences of each event and the first three changes of each pin, and some random
/// ticks.
Aimed telling(const Recorded& slave, std::mt19937& random) {
  Heard heard;
  const auto chip = make_chip(slave.config, Way::kSkip, heard);
  play(*chip, slave, 0, slave.end);
  std::set<Tick> ticks;
  const auto below = [&random](Tick limit) { return static_cast<Tick>(random() % static_cast<std::uint64_t>(limit)); };
  const auto add = [&](Tick tick) {
    for (const Tick each : {tick, tick + 1 + below(500)})
      if (each < slave.end) ticks.insert(each);
  };
  std::map<std::string, int> events;
  for (const profibus::Event& each : heard.events)
    if (events[profibus::code(each.reason)]++ < 2) add(each.at);
  std::map<std::pair<Pin, bool>, int> changes;
  for (const std::vector<Input>* pins : {&std::as_const(heard).pins, &slave.inputs})
    for (const Input& each : *pins)
      if (changes[{each.pin, each.level != 0}]++ < 3) add(each.at);
  for (int i = 0; i < 30; ++i) add(below(slave.end));
  Aimed aimed{slave, {}};
  std::size_t inputs = 0;
  for (const Tick tick : ticks) {
    while (inputs < slave.inputs.size() && slave.inputs[inputs].at <= tick) ++inputs;
    aimed.moments.push_back({tick, inputs});
  }
  return aimed;
}

TEST(StateFields, AreFoundWhenTheyAreLeftOut) {
  constexpr Tick kMs = 12'000'000;
  Search search;
  for (const Act& each : acts()) search.look(each);
  for (const Aimed& each : aimed())
    for (const Way way : {Way::kSkip, Way::kStep}) search.look(each, way, way == Way::kSkip ? kMs : kMs / 15);
  std::mt19937 random(17);
  int number = 0;
  for (const std::string& scenario : recorded_scenarios())
    for (const Recorded& slave : recorded(scenario))
      search.look(telling(slave, random), ++number % 2 == 0 ? Way::kSkip : Way::kDoze, 5 * kMs);
  search.expect_all();
}

}  // namespace
}  // namespace dsdpv1::state_test

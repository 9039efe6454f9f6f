#include "apps/commands/compare_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <iostream>

#include "apps/command_line.hpp"
#include "apps/interrupt.hpp"
#include "apps/options/outputs.hpp"
#include "cosim/wave_pins.hpp"
#include "io/input/input_error.hpp"
#include "io/waves/wave_writer.hpp"
#include "lab/compare/comparison.hpp"
#include "lab/compare/report.hpp"
#include "tb/report/progress.hpp"

namespace dsdpv1::app {
namespace {

using tb::compare::Femtoseconds;
using tb::compare::NamedPair;
using tb::compare::Options;

std::optional<Femtoseconds> duration(const std::string& option, const std::string& text, bool negative) {
  if (text.empty()) return std::nullopt;
  const std::optional<Femtoseconds> value = tb::compare::parse_duration(text);
  if (value && (negative || *value >= 0)) return value;
  throw tb::InputError("dsdpv1-sim compare: " + option + " is " + text + ", allowed is " + tb::compare::kDurationForm);
}

/// Where an option's words stand for the values of a rule.
template <class Rule, std::size_t N>
Rule rule(const std::string& option, const std::string& word,
          const std::array<std::pair<const char*, Rule>, N>& rules) {
  std::vector<std::string> words;
  for (const auto& [name, value] : rules) {
    if (word == name) return value;
    words.emplace_back(name);
  }
  check_word(option, word, words);
  return rules[0].second;
}

tb::compare::XRule x_rule(const std::string& word) {
  using Rule = tb::compare::XRule;
  const std::array<std::pair<const char*, Rule>, 4> rules = {
      {{"expected", Rule::kExpected}, {"any", Rule::kAny}, {"equal", Rule::kEqual}, {"never", Rule::kNever}}};
  return rule("compare: --x", word, rules);
}

tb::compare::ZRule z_rule(const std::string& word) {
  using Rule = tb::compare::ZRule;
  const std::array<std::pair<const char*, Rule>, 3> rules = {
      {{"equal", Rule::kEqual}, {"expected", Rule::kExpected}, {"any", Rule::kAny}}};
  return rule("compare: --z", word, rules);
}

/// The pins of the map, and what --signal says instead or besides.
std::vector<NamedPair> pairs_of(const CompareArguments& arguments) {
  std::vector<NamedPair> pairs;
  if (arguments.pins == kOwnRtl)
    pairs = cosim::pairs_of(cosim::default_pin_map());
  else if (!arguments.pins.empty())
    pairs = cosim::pairs_of(cosim::load_pin_map(arguments.pins));
  for (const std::string& text : arguments.signals) {
    NamedPair pair = tb::compare::parse_pair(text);
    const auto same = [&](const NamedPair& other) { return other.a == pair.a; };
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), same), pairs.end());
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

Options options_of(const CompareArguments& arguments) {
  Options options;
  options.scope_a = arguments.scope_a.empty() ? arguments.scope : arguments.scope_a;
  options.scope_b = arguments.scope_b.empty() ? arguments.scope : arguments.scope_b;
  options.pairs = pairs_of(arguments);
  options.from = duration("--from", arguments.from, false);
  options.to = duration("--to", arguments.to, false);
  options.shift = duration("--shift", arguments.shift, true).value_or(0);
  options.tolerance = duration("--tolerance", arguments.tolerance, false);
  if (!arguments.clock.empty()) options.clock = tb::compare::parse_clock(arguments.clock);
  options.x = x_rule(arguments.x);
  options.z = z_rule(arguments.z);
  for (const std::string& mask : arguments.masks) options.masks.push_back(tb::compare::parse_mask(mask));
  return options;
}

void check_files(const CompareArguments& arguments) {
  if (!arguments.wave.empty()) tb::check_wave_name(arguments.wave);
  check_outputs("dsdpv1-sim compare",
                {{"A", arguments.a}, {"B", arguments.b}, {"--pins", arguments.pins == kOwnRtl ? "" : arguments.pins}},
                {{"--wave", arguments.wave}, {"--json", arguments.json}, {"--junit", arguments.junit}});
}

}  // namespace

int compare(const CompareArguments& arguments) {
  leave_nothing_on_signals();
  const Options options = options_of(arguments);
  check_files(arguments);
  tb::compare::Comparison comparison(arguments.a, arguments.b, options,
                                     [] { return std::make_unique<cosim::PinSurroundings>(); });
  if (!arguments.wave.empty()) comparison.write_wave(arguments.wave);
  tb::ShareProgress progress(arguments.progress.value_or(isatty(STDERR_FILENO) != 0));
  comparison.on_progress([&progress](double share) { progress.show(share); });
  const tb::compare::Result result = comparison.run();
  progress.clear();
  write_wanted(arguments.json, tb::compare::json(result));
  write_wanted(arguments.junit, tb::compare::junit(result));
  if (!arguments.quiet) std::cout << tb::compare::text(result);
  return result.equal() ? kPassed : kFailed;
}

}  // namespace dsdpv1::app

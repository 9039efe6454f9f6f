#pragma once
// The parts of the description of a scenario's keys, one function per mapping.
#include <map>

#include "io/keys/keys.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::scenario {

using keys::Choice;
using keys::ObjectOf;
using keys::Range;
using keys::WordFor;

/// The result of `describe` for this kind of chip, made once.
template <class T>
const ObjectOf<T>& per_kind(const ChipKind& kind, ObjectOf<T> (*describe)(const ChipKind& kind)) {
  static std::map<const ChipKind*, ObjectOf<T>> all;
  const auto found = all.find(&kind);
  return found != all.end() ? found->second : all.emplace(&kind, describe(kind)).first->second;
}

/// The key `chip` of a Scenario or Slave.
template <class Owner>
keys::Field chip_field(const ChipKind& kind, const char* doc);
/// The kind that the mapping names in `chip`; `usual` if it names none. Throws InputError if there is none of this
/// name.
const ChipKind& kind_in(const YAML::Node& mapping, const ChipKind& usual, const keys::Source& source);

const ObjectOf<Master>& master_keys();
const ObjectOf<BusParameters>& bus_keys();
const ObjectOf<Master2>& master2_keys();
const ObjectOf<Slave>& slave_keys(const ChipKind& kind);
const std::vector<WordFor<bus::ConnectionState>>& connection_state_words();
const ObjectOf<Dpv1User>& dpv1_keys();
const std::vector<WordFor<Answering>>& answering_words();
const ObjectOf<Action>& action_keys(const ChipKind& kind);
const ObjectOf<When>& when_keys();
const ObjectOf<Expectation>& expectation_keys();
const ObjectOf<Allow>& allow_keys();
const ObjectOf<Checks>& check_keys(const ChipKind& kind);

/// The ten baud rates, fastest first.
std::vector<WordFor<int>> baud_words();
/// ... and the word for a chip without a rate.
std::vector<WordFor<std::optional<int>>> found_baud_words();

constexpr bus::Tick kLongestTime = 3600 * bus::kTicksPerSecond;
constexpr Range kAnyTime = {0, kLongestTime};
constexpr Range kAddresses = {0, 126};
constexpr Range kItems = {0, 1000};

}  // namespace dsdpv1::tb::scenario

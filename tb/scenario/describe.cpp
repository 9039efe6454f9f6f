// The scenario itself and the chip's parameters.
#include "tb/scenario/describe.hpp"

#include <map>

#include "bus/baud.hpp"

namespace dsdpv1::tb::scenario {

std::vector<WordFor<int>> baud_words() {
  std::vector<WordFor<int>> words;
  words.reserve(bus::kBaudCount);
  // NOLINTNEXTLINE(bugprone-suspicious-stringview-data-usage): a literal
  for (int i = 0; i < bus::kBaudCount; ++i) words.push_back({i, bus::baud(i).name.data(), ""});
  return words;
}

std::vector<WordFor<std::optional<int>>> found_baud_words() {
  std::vector<WordFor<std::optional<int>>> words;
  words.reserve(bus::kBaudCount + 1);
  for (const WordFor<int>& each : baud_words()) words.push_back({each.value, each.text, each.doc});
  words.push_back({std::nullopt, "searching", "the chip searches the baud rate"});
  return words;
}

namespace {

keys::Field kind_field() {
  keys::Field field;
  field.name = "kind";
  field.type.kind = keys::Kind::kWord;
  for (const ChipKind* each : chip_kinds()) field.type.words.push_back({each->name(), ""});
  field.default_text = chip_kinds().front()->name();
  field.doc =
      "Kind of the chip. The other keys, some keys of `user_cpu`, the checks and some actions are those of this chip.";
  field.read = [self = field](void*, const YAML::Node& node, const keys::Source& source) {
    keys::read_word(self, node, source);  // `kind_in` has already read it
  };
  return field;
}

const keys::Object& chip_keys(const ChipKind& kind) {
  static std::map<const ChipKind*, keys::Object> all;
  auto found = all.find(&kind);
  if (found == all.end()) {
    found = all.emplace(&kind, kind.chip_keys()).first;
    found->second.fields.insert(found->second.fields.begin(), kind_field());
  }
  return found->second;
}

void set_chip(Scenario& scenario, const ChipKind& /*kind*/, std::unique_ptr<OwnSettings> settings) {
  scenario.chip = std::move(settings);
}

void set_chip(Slave& slave, const ChipKind& kind, std::unique_ptr<OwnSettings> settings) {
  slave.kind = &kind;
  slave.chip = std::move(settings);
}

/// Missing keys leave the chip's limits unchanged.
keys::Field checks_field(const ChipKind& kind) {
  keys::Field field;
  field.name = "checks";
  field.type.kind = keys::Kind::kObject;
  field.type.object = &check_keys(kind);
  field.doc = "Effect of violations that the checks find, and limits other than their defaults.";
  field.read = [keys = field.type.object](void* owner, const YAML::Node& node, const keys::Source& source) {
    keys::read_object(*keys, &static_cast<Scenario*>(owner)->checks, node, source);
  };
  return field;
}

}  // namespace

template <class Owner>
keys::Field chip_field(const ChipKind& kind, const char* doc) {
  keys::Field field;
  field.name = "chip";
  field.type.kind = keys::Kind::kObject;
  field.type.object = &chip_keys(kind);
  field.doc = doc;
  field.read = [&kind, keys = field.type.object](void* owner, const YAML::Node& node, const keys::Source& source) {
    std::unique_ptr<OwnSettings> settings = kind.make_chip_settings();
    keys::read_object(*keys, dynamic_cast<void*>(settings.get()), node, source);
    kind.check_chip(*settings, source);
    set_chip(*static_cast<Owner*>(owner), kind, std::move(settings));
  };
  return field;
}
template keys::Field chip_field<Slave>(const ChipKind& kind, const char* doc);

/// Anything but a word is left to the reader of the key.
const ChipKind& kind_in(const YAML::Node& mapping, const ChipKind& usual, const keys::Source& source) {
  const YAML::Node chip = mapping.IsMap() ? mapping["chip"] : YAML::Node();
  const YAML::Node name = chip.IsDefined() && chip.IsMap() ? chip["kind"] : YAML::Node();
  if (!name.IsDefined() || !name.IsScalar()) return usual;
  const keys::Field field = kind_field();
  return *chip_kinds().at(keys::read_word(field, name, source));
}

const ObjectOf<Allow>& allow_keys() {
  static const ObjectOf<Allow> keys = [] {
    ObjectOf<Allow> o("allow", "A violation that is part of the scenario and does not fail the run.");
    o.name_of("event", &Allow::event, "Code of the event, as in the log and in docs/reasons.md, or id of a check.")
        .required = true;
    o.name_of("slave", &Allow::slave, "Only of this slave (default: of any slave or of the bus).");
    return o;
  }();
  return keys;
}

namespace {

ObjectOf<Scenario> describe_scenario(const ChipKind& kind) {
  ObjectOf<Scenario> o("scenario", "A bus with its masters and slaves, the events on it, and the expectations.");
  o.text("name", &Scenario::name, "Title of the scenario, one line.").required = true;
  o.word("baud", &Scenario::baud, baud_words(), "Baud rate of the masters; the chips find it themselves.").required =
      true;
  o.time("end", &Scenario::end, {bus::kTicksPerUs, kLongestTime}, "End of the run.").required = true;
  o.fields.push_back(chip_field<Scenario>(kind, "Kind of the slaves' chips, and parameters other than its defaults."));
  o.list("masters", &Scenario::masters, master_keys(), {0, 4},
         "The DP masters class 1. Several at a time, and those beside masters of class 2, need `bus: {ring: true}`.");
  o.list("masters2", &Scenario::masters2, master2_keys(), {0, 4}, "The DP masters class 2.");
  o.list("slaves", &Scenario::slaves, slave_keys(kind), {0, 125},
         "The chips, each with its user CPU; none only with `serve`.",
         [&kind](const YAML::Node& slave, const keys::Source& source) -> const keys::Object& {
           return slave_keys(kind_in(slave, kind, source));
         })
      .required = true;
  o.list("script", &Scenario::script, action_keys(kind), kItems, "Actions during the run.");
  o.list_or("expect", &Scenario::expect, expectation_keys(), kItems, {"none", "not even data exchange"},
            &Scenario::expects_exchange,
            "Conditions that must be true, else the run fails (exit 1). In addition, each slave of a class 1 master "
            "must reach data exchange and stay there (docs/verdicts.md).");
  o.list("allow", &Scenario::allow, allow_keys(), kItems,
         "Violations that are expected. Every other one fails the run.");
  o.fields.push_back(checks_field(kind));
  return o;
}

}  // namespace

const keys::Object& description(const ChipKind& kind) { return per_kind<Scenario>(kind, describe_scenario); }

}  // namespace dsdpv1::tb::scenario

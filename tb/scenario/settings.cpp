#include "tb/scenario/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "tb/scenario/describe.hpp"

namespace dsdpv1::tb::scenario {
namespace {

using keys::Field;
using keys::Kind;
using keys::Object;
using Steps = std::vector<std::string>;

[[noreturn]] void fail(const std::string& origin, const std::string& text) { throw InputError(origin, 0, text); }

Steps split(const std::string& path) {
  Steps steps(1);
  for (const char c : path)
    if (c == '.')
      steps.emplace_back();
    else
      steps.back() += c;
  return steps;
}

std::vector<std::string> names_of(const Object& object) {
  std::vector<std::string> names;
  for (const Field& field : object.fields) names.push_back(field.name);
  return names;
}

/// True if a path with this first step applies to every slave.
bool of_every_slave(const std::string& first, const ChipKind& kind) {
  return description(kind).find(first) == nullptr && slave_keys(kind).find(first) != nullptr;
}

const Field& find(const Object& object, const std::string& step, const ChipKind& kind, const std::string& origin) {
  if (const Field* field = object.find(step)) return *field;
  std::vector<std::string> names = names_of(object);
  const std::string allowed = join(names);
  std::string more;
  if (&object == &description(kind)) {
    const std::vector<std::string> of_slave = names_of(slave_keys(kind));
    more = "; of every slave " + join(of_slave);
    names.insert(names.end(), of_slave.begin(), of_slave.end());
  }
  fail(origin, fmt::format("unknown key {} in {}{}, expected {}{}", step, object.name, did_you_mean(step, names),
                           allowed, more));
}

bool has_items(const Field& field) { return field.type.kind == Kind::kList && field.type.object != nullptr; }
bool has_keys(const Field& field) { return field.type.kind == Kind::kObject; }

/// The end of a path must be one value.
void check_end(const Field& field, const std::string& origin) {
  if (has_keys(field))
    fail(origin, fmt::format("{} is a mapping, expected its keys {}", field.name, join(names_of(*field.type.object))));
  if (has_items(field))
    fail(origin, fmt::format("{} is a list, expected the keys of one item, like {}.0.{}", field.name, field.name,
                             field.type.object->fields.front().name));
}

/// Before its end a path must lead into a mapping or a list.
void check_middle(const Field& field, const std::string& next, const std::string& origin) {
  if (has_keys(field) || has_items(field)) return;
  fail(origin, fmt::format("{} is one value, expected no key {} below it", field.name, next));
}

const Field& walk(const Object& object, const Steps& steps, std::size_t at, const ChipKind& kind,
                  const std::string& origin) {
  const Field& field = find(object, steps[at], kind, origin);
  if (at + 1 == steps.size()) {
    if (field.type.words.empty()) check_end(field, origin);  // else a word may replace it
    return field;
  }
  check_middle(field, steps[at + 1], origin);
  const std::size_t next = at + (has_items(field) ? 2 : 1);
  if (next >= steps.size()) check_end(field, origin);
  return walk(*field.type.object, steps, std::min(next, steps.size() - 1), kind, origin);
}

void check_value(const Field& field, const YAML::Node& value, const std::string& origin) {
  const keys::Source source = {origin};
  switch (field.type.kind) {
    case Kind::kInteger: keys::read_integer(field, value, source); break;
    case Kind::kNumber: keys::read_number(field, value, source); break;
    case Kind::kBoolean: keys::read_boolean(field, value, source); break;
    case Kind::kWord: keys::read_word(field, value, source); break;
    case Kind::kTime: keys::read_time(field, value, source); break;
    case Kind::kBytes:
      if (!keys::is_word_of(field, value)) keys::read_bytes(field, value, source);
      break;
    case Kind::kList:
      if (!keys::is_word_of(field, value)) keys::check_list(field, value, source);
      break;
    default: keys::read_text(field, value, source); break;
  }
}

/// A value from the command line is text, hexadecimal for bytes, unless it is a list in brackets. A path is relative to
/// the user's working folder; paths in the scenario are relative to its folder.
YAML::Node value_of(const Field& field, const Setting& setting) {
  const bool list = field.type.kind == Kind::kList || field.type.kind == Kind::kBytes;
  YAML::Node value(setting.value);
  if (list && !setting.value.empty() && setting.value.front() == '[') {
    try {
      value.reset(YAML::Load(setting.value));
    } catch (const YAML::Exception&) {
      fail(setting.origin, fmt::format("{} is no list, expected something like [1, 2]", setting.value));
    }
  }
  check_value(field, value, setting.origin);
  if (field.type.kind == Kind::kFile) value = given_path(setting.value);
  return value;
}

std::vector<std::string> item_names(const YAML::Node& list) {
  std::vector<std::string> names;
  for (const YAML::Node& item : list)
    if (item.IsMap() && item["name"].IsDefined() && item["name"].IsScalar()) names.push_back(item["name"].Scalar());
  return names;
}

std::optional<std::size_t> item_number(const YAML::Node& list, const std::string& step) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const YAML::Node item = list[i];
    const bool named = item.IsMap() && item["name"].IsDefined() && item["name"].IsScalar();
    if (std::to_string(i) == step || (named && item["name"].Scalar() == step)) return i;
  }
  return std::nullopt;
}

/// The kind of the slave to whose item the path leads; else `usual`.
const ChipKind& kind_of_item(const YAML::Node& slaves, const Steps& steps, const ChipKind& usual,
                             const Setting& setting) {
  if (steps[0] != "slaves" || steps.size() < 2 || !slaves.IsDefined() || !slaves.IsSequence()) return usual;
  const std::optional<std::size_t> number = item_number(slaves, steps[1]);
  return number ? kind_in(slaves[*number], usual, {setting.origin}) : usual;
}

class Writer {
 public:
  Writer(const Setting& setting, const ChipKind& kind, const Steps& steps, const YAML::Node& value)
      : setting_(setting), kind_(kind), steps_(steps), value_(value) {}

  void write(YAML::Node node, const Object& object, std::size_t at) const {
    if (!node.IsMap()) fail(setting_.origin, fmt::format("{} is no mapping in the scenario", object.name));
    const Field& field = find(object, steps_[at], kind_, setting_.origin);
    if (at + 1 == steps_.size()) {
      put(node[field.name]);
    } else if (has_items(field)) {
      const YAML::Node chosen = item(node[field.name], field, steps_[at + 1]);
      write(chosen, field.type.object_of(chosen, {setting_.origin}), at + 2);
    } else {
      if (!node[field.name].IsDefined()) node[field.name] = YAML::Node(YAML::NodeType::Map);
      mark(node[field.name]);
      write(node[field.name], *field.type.object, at + 1);
    }
  }

 private:
  /// Assigns text to the existing node, which keeps its line for errors; the text counts as quoted.
  void put(YAML::Node slot) const {
    if (value_.IsScalar())
      slot = value_.Scalar();
    else
      slot = YAML::Clone(value_);
    mark(slot);
  }
  void mark(YAML::Node node) const { node.SetTag(keys::kOptionTag + setting_.origin); }

  YAML::Node item(const YAML::Node& list, const Field& field, const std::string& step) const {
    if (!list.IsDefined() || !list.IsSequence() || list.size() == 0)
      fail(setting_.origin, fmt::format("the scenario has no {}", field.name));
    if (const std::optional<std::size_t> number = item_number(list, step)) return list[*number];
    std::vector<std::string> names = item_names(list);
    const std::string near = did_you_mean(step, names);
    names.insert(names.begin(), list.size() == 1 ? "0" : fmt::format("0 to {}", list.size() - 1));
    fail(setting_.origin, fmt::format("{} has no item {}{}, expected {}", field.name, step, near, join(names)));
  }

  const Setting& setting_;
  const ChipKind& kind_;
  const Steps& steps_;
  const YAML::Node& value_;
};

}  // namespace

std::string given_path(const std::string& path) { return std::filesystem::absolute(path).lexically_normal().string(); }

Setting parse_setting(const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string origin = option + " " + text;
  if (equals == std::string::npos || equals == 0) fail(origin, "expected PATH=VALUE, like user_cpu.cycle=40us");
  return {text.substr(0, equals), text.substr(equals + 1), origin};
}

std::vector<Setting> parse_settings(const std::vector<std::string>& texts) {
  std::vector<Setting> settings;
  settings.reserve(texts.size());
  for (const std::string& text : texts) settings.push_back(parse_setting("--set", text));
  return settings;
}

const Field& field_of(const std::string& path, const ChipKind& kind, const std::string& origin) {
  const Steps steps = split(path);
  return walk(of_every_slave(steps[0], kind) ? slave_keys(kind) : description(kind), steps, 0, kind, origin);
}

const Field& field_of_any(const std::string& path, const std::string& origin) {
  for (const ChipKind* kind : chip_kinds()) {
    try {
      return field_of(path, *kind, origin);
    } catch (const InputError&) {
      if (kind == chip_kinds().back()) break;
    }
  }
  return field_of(path, *chip_kinds().front(), origin);  // it reports the error
}

void check(const Setting& setting) { value_of(field_of_any(setting.path, setting.origin), setting); }

void apply(const Setting& setting, const ChipKind& kind, YAML::Node& root) {
  const Steps steps = split(setting.path);
  const YAML::Node slaves = root.IsMap() ? root["slaves"] : YAML::Node();
  const auto put = [&](const YAML::Node& node, const Object& object, const ChipKind& own) {
    const YAML::Node value = value_of(field_of(setting.path, own, setting.origin), setting);
    Writer(setting, own, steps, value).write(node, object, 0);
  };
  if (!of_every_slave(steps[0], kind)) return put(root, description(kind), kind_of_item(slaves, steps, kind, setting));
  if (!slaves.IsDefined() || !slaves.IsSequence()) return check(setting);  // the reader reports the fault of the file
  for (const YAML::Node& slave : slaves) {
    const ChipKind& own = kind_in(slave, kind, {setting.origin});
    put(slave, slave_keys(own), own);
  }
}

}  // namespace dsdpv1::tb::scenario

#include "io/keys/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"
#include "io/input/units.hpp"

namespace dsdpv1::tb::keys {
namespace {

[[noreturn]] void fail(const Source& source, const YAML::Node& node, const std::string& text) {
  throw InputError(source.file, line_of(node), text);
}

/// The text in the file, short enough for an error line.
std::string shown(const YAML::Node& node) {
  if (node.IsSequence()) return "a list";
  if (node.IsMap()) return "a mapping";
  if (!node.IsDefined() || node.IsNull()) return "nothing";
  const std::string& text = node.Scalar();
  return "\"" + (text.size() > 40 ? text.substr(0, 40) + "..." : text) + "\"";
}

const std::string& scalar(const Field& field, const YAML::Node& node, const Source& source,
                          const std::string& allowed) {
  if (!node.IsScalar()) fail(source, node, fmt::format("{} is {}, expected {}", field.name, shown(node), allowed));
  return node.Scalar();
}

std::string integer_form(const Field& field) {
  const std::string unit = field.type.unit.empty() ? "" : " " + field.type.unit;
  return fmt::format("a whole number from {} to {}{}", field.type.range.min, field.type.range.max, unit);
}

std::string bytes_form(const Field& field) {
  std::string words;
  for (const Word& word : field.type.words) words += ", or " + word.text;
  return fmt::format("{} to {} bytes as quoted hexadecimal text (\"01 A0 00*4\") or as a list of numbers ([1, 0xA0]){}",
                     field.type.range.min, field.type.range.max, words);
}

bus::Bytes read_byte_list(const Field& field, const YAML::Node& node, const Source& source) {
  bus::Bytes bytes;
  for (const YAML::Node& item : node) {
    const std::optional<std::int64_t> value = item.IsScalar() ? parse_integer(item.Scalar()) : std::nullopt;
    if (!value || *value < 0 || *value > 255)
      fail(source, item, fmt::format("{} holds {}, expected numbers from 0 to 255", field.name, shown(item)));
    bytes.push_back(static_cast<std::uint8_t>(*value));
  }
  return bytes;
}

std::vector<std::string> names_of(const Object& object) {
  std::vector<std::string> names;
  for (const Field& field : object.fields) names.push_back(field.name);
  return names;
}

bool contains(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::string key_text(const YAML::Node& key, const Source& source) {
  if (!key.IsScalar()) fail(source, key, fmt::format("a key is {}, expected a word", shown(key)));
  return key.Scalar();
}

/// The choice that the selector of `object` names in `node`.
const Choice& chosen(const Object& object, const YAML::Node& node, const Source& source) {
  const YAML::Node word = node[object.selector];
  if (!word.IsDefined())
    fail(source, node, fmt::format("{} is missing in {}, expected {}", object.selector, object.name, join([&] {
                                     std::vector<std::string> words;
                                     for (const Choice& choice : object.choices) words.push_back(choice.word);
                                     return words;
                                   }())));
  return object.choices[read_word(*object.find(object.selector), word, source)];
}

/// Names of the fields that may be in this mapping.
std::vector<std::string> allowed_keys(const Object& object, const Choice* choice) {
  if (choice == nullptr) return names_of(object);
  std::vector<std::string> keys = object.always;
  keys.push_back(object.selector);
  keys.insert(keys.end(), choice->required.begin(), choice->required.end());
  keys.insert(keys.end(), choice->optional.begin(), choice->optional.end());
  return keys;
}

void check_groups(const Object& object, const std::set<std::string>& seen, const YAML::Node& node,
                  const Source& source) {
  const auto count = [&seen](const std::vector<std::string>& group) {
    return std::count_if(group.begin(), group.end(), [&seen](const std::string& key) { return seen.count(key) != 0; });
  };
  for (const auto& group : object.exactly_one) {
    const auto found = count(group);
    if (found == 0) fail(source, node, fmt::format("{} needs exactly one of {}", object.name, join(group)));
    if (found > 1)
      fail(source, node, fmt::format("{} has {} of {}, expected exactly one", object.name, found, join(group)));
  }
  for (const auto& group : object.at_most_one)
    if (count(group) > 1)
      fail(source, node, fmt::format("{} has {} of {}, expected one at most", object.name, count(group), join(group)));
  for (const auto& group : object.at_least_one)
    if (count(group) == 0) fail(source, node, fmt::format("{} needs at least one of {}", object.name, join(group)));
}

void check_required(const Object& object, const Choice* choice, const std::set<std::string>& seen,
                    const YAML::Node& node, const Source& source) {
  for (const Field& field : object.fields) {
    const bool needed = field.required || (choice != nullptr && contains(choice->required, field.name));
    if (!needed || seen.count(field.name) != 0) continue;
    const std::string where = choice != nullptr ? fmt::format("{} {}", object.selector, choice->word) : object.name;
    fail(source, node, fmt::format("{} is missing in {}", field.name, where));
  }
}

}  // namespace

const Field* Object::find(const std::string& key) const {
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&key](const Field& field) { return field.name == key; });
  return found == fields.end() ? nullptr : &*found;
}

std::string option_of(const YAML::Node& node) {
  const std::string& tag = node.Tag();
  const std::size_t length = std::char_traits<char>::length(kOptionTag);
  return tag.compare(0, length, kOptionTag) == 0 ? tag.substr(length) : "";
}

int line_of(const YAML::Node& node) { return node.Mark().line + 1; }

std::int64_t read_integer(const Field& field, const YAML::Node& node, const Source& source) {
  const std::string allowed = integer_form(field);
  const std::optional<std::int64_t> value = parse_integer(scalar(field, node, source, allowed));
  if (!value || *value < field.type.range.min || *value > field.type.range.max)
    fail(source, node, fmt::format("{} is {}, expected {}", field.name, shown(node), allowed));
  return *value;
}

double read_number(const Field& field, const YAML::Node& node, const Source& source) {
  const std::string allowed =
      fmt::format("a number from {} to {} {}", field.type.range.min, field.type.range.max, field.type.unit);
  double value = 0;
  scalar(field, node, source, allowed);
  const bool good = YAML::convert<double>::decode(node, value) && std::isfinite(value);
  if (!good || value < static_cast<double>(field.type.range.min) || value > static_cast<double>(field.type.range.max))
    fail(source, node, fmt::format("{} is {}, expected {}", field.name, shown(node), allowed));
  return value;
}

bool read_boolean(const Field& field, const YAML::Node& node, const Source& source) {
  const std::string& text = scalar(field, node, source, "true or false");
  if (text != "true" && text != "false")
    fail(source, node, fmt::format("{} is {}, expected true or false", field.name, shown(node)));
  return text == "true";
}

std::string read_text(const Field& field, const YAML::Node& node, const Source& source) {
  const std::string& text = scalar(field, node, source, "text");
  if (text.empty()) fail(source, node, fmt::format("{} is empty, expected text", field.name));
  const auto most = static_cast<std::size_t>(field.type.range.max);
  if (most != 0 && text.size() > most)
    fail(source, node, fmt::format("{} has {} characters, expected at most {}", field.name, text.size(), most));
  return text;
}

std::size_t read_word(const Field& field, const YAML::Node& node, const Source& source) {
  std::vector<std::string> words;
  for (const Word& word : field.type.words) words.push_back(word.text);
  const std::string& text = scalar(field, node, source, "one of " + join(words));
  const auto found = std::find(words.begin(), words.end(), text);
  if (found == words.end()) {
    fail(source, node,
         fmt::format("{} is {}{}, expected {}", field.name, shown(node), did_you_mean(text, words), join(words)));
  }
  return static_cast<std::size_t>(found - words.begin());
}

bus::Tick read_time(const Field& field, const YAML::Node& node, const Source& source) {
  const std::optional<bus::Tick> time = parse_time(scalar(field, node, source, kTimeForm));
  if (!time) fail(source, node, fmt::format("{} is {}, expected {}", field.name, shown(node), kTimeForm));
  if (*time < field.type.range.min || *time > field.type.range.max) {
    fail(source, node,
         fmt::format("{} is {}, expected {} to {}", field.name, shown(node), time_text(field.type.range.min),
                     time_text(field.type.range.max)));
  }
  return *time;
}

bus::Bytes read_bytes(const Field& field, const YAML::Node& node, const Source& source) {
  bus::Bytes bytes;
  if (node.IsSequence()) {
    bytes = read_byte_list(field, node, source);
  } else {
    const std::string& text = scalar(field, node, source, bytes_form(field));
    // 10 alone could be meant in decimal: one plain number must be quoted, or be in a list.
    const bool plain_number = node.Tag() == "?" && parse_integer(text).has_value();
    const std::optional<bus::Bytes> parsed = plain_number ? std::nullopt : parse_bytes(text);
    if (!parsed) fail(source, node, fmt::format("{} is {}, expected {}", field.name, shown(node), bytes_form(field)));
    bytes = *parsed;
  }
  const auto length = static_cast<std::int64_t>(bytes.size());
  if (length < field.type.range.min || length > field.type.range.max) {
    fail(source, node,
         fmt::format("{} has {} bytes, expected {} to {}", field.name, length, field.type.range.min,
                     field.type.range.max));
  }
  return bytes;
}

bool is_word_of(const Field& field, const YAML::Node& node) {
  return node.IsScalar() && std::any_of(
                                field.type.words.begin(), field.type.words.end(),
                                [&node](const Word& word) { return node.Scalar() == word.text; });
}

void check_list(const Field& field, const YAML::Node& node, const Source& source) {
  if (!node.IsSequence()) {
    std::string words;
    for (const Word& word : field.type.words) words += " or " + word.text;
    fail(source, node, fmt::format("{} is {}, expected a list{}", field.name, shown(node), words));
  }
  const auto items = static_cast<std::int64_t>(node.size());
  if (items < field.type.range.min || items > field.type.range.max) {
    fail(source, node,
         fmt::format("{} has {} items, expected {} to {}", field.name, items, field.type.range.min,
                     field.type.range.max));
  }
}

void read_object(const Object& object, void* owner, const YAML::Node& node, const Source& source) {
  if (!node.IsMap())
    fail(
        source, node,
        fmt::format("{} is {}, expected a mapping with the keys {}", object.name, shown(node), join(names_of(object))));
  object.set_line(owner, line_of(node));
  const Choice* choice = object.selector.empty() ? nullptr : &chosen(object, node, source);
  const std::vector<std::string> allowed = allowed_keys(object, choice);
  std::set<std::string> seen;
  for (const auto& pair : node) {
    const std::string key = key_text(pair.first, source);
    if (!contains(allowed, key)) {
      const std::string where = choice != nullptr ? fmt::format("{} {}", object.selector, choice->word) : object.name;
      fail(source, pair.first,
           fmt::format("unknown key {} in {}{}, expected {}", key, where, did_you_mean(key, allowed), join(allowed)));
    }
    if (!seen.insert(key).second)
      fail(source, pair.first, fmt::format("{} is there twice in {}, expected once", key, object.name));
    object.find(key)->read(owner, pair.second, source);
    if (object.note_key) object.note_key(owner, {key, line_of(pair.first), option_of(pair.second)});
  }
  check_required(object, choice, seen, node, source);
  check_groups(object, seen, node, source);
}

std::string default_text(std::int64_t value) { return std::to_string(value); }
std::string default_number(double value) { return fmt::format("{}", value); }
std::string default_time(bus::Tick value) { return time_text(value); }

}  // namespace dsdpv1::tb::keys

#include "capi/parameter.hpp"

#include <algorithm>
#include <map>
#include <sstream>

#include "capi/error.hpp"
#include "capi/kind.hpp"
#include "io/input/units.hpp"
#include "io/keys/keys.hpp"

namespace dsdpv1::capi {
namespace {

using tb::keys::Field;

/// "[7, 2, 4]", the default of a list in the keys.
std::vector<std::int64_t> numbers_of(std::string list) {
  std::replace_if(
      list.begin(), list.end(), [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
  std::istringstream words(list);
  std::vector<std::int64_t> numbers;
  for (std::int64_t number = 0; words >> number;) numbers.push_back(number);
  return numbers;
}

/// A word as a number: its place.
std::int64_t place_of(const std::string& word, const Field& field) {
  const auto& words = field.type.words;
  const auto found = std::find_if(words.begin(), words.end(), [&](const auto& each) { return each.text == word; });
  return found - words.begin();
}

std::string text_of(std::int64_t value, const Field& field) {
  if (field.type.kind == tb::keys::Kind::kTime) return tb::time_text(value);
  if (field.type.kind != tb::keys::Kind::kWord) return std::to_string(value);
  return field.type.words.at(static_cast<std::size_t>(value)).text;
}

void add(std::vector<Parameter>& all, const Field& field) {
  if (field.type.kind == tb::keys::Kind::kWord)
    all.push_back({field.name,
                   &field,
                   {},
                   {0, static_cast<std::int64_t>(field.type.words.size()) - 1},
                   place_of(field.default_text, field)});
  if (field.type.kind == tb::keys::Kind::kInteger)
    all.push_back({field.name, &field, {}, field.type.range, std::stoll(field.default_text)});
  if (field.type.kind == tb::keys::Kind::kTime)
    all.push_back({field.name, &field, {}, field.type.range, tb::parse_time(field.default_text).value()});
  if (field.type.kind != tb::keys::Kind::kList || field.type.element != tb::keys::Kind::kInteger) return;
  const std::vector<std::int64_t> usual = numbers_of(field.default_text);
  for (std::size_t i = 0; i < usual.size(); ++i)
    all.push_back({field.name + "[" + std::to_string(i) + "]", &field, i, field.type.each, usual[i]});
}

const Parameter& find(const std::vector<Parameter>& all, const char* name) {
  need(name, "name of a parameter");
  const auto found = std::find_if(all.begin(), all.end(), [&](const Parameter& each) { return each.name == name; });
  if (found == all.end()) fail(DPSIM_ERR_NOT_FOUND, "the chip has no parameter \"" + std::string(name) + "\"");
  return *found;
}

}  // namespace

std::vector<Parameter> parameters_of(const tb::ChipKind& chip) {
  std::vector<Parameter> all;
  for (const Field& field : chip.chip_keys().fields)
    if (!chip.is_strap(field.name)) add(all, field);
  return all;
}

void set_parameters(const dpsim_parameter* values, std::size_t count, const Kind& kind, tb::OwnSettings& settings) {
  std::map<const Field*, std::vector<std::int64_t>> lists;
  for (std::size_t i = 0; i < count; ++i) {
    const Parameter& parameter = find(kind.parameters, values[i].name);
    need_range(values[i].name, values[i].value, parameter.range.min, parameter.range.max);
    if (!parameter.element) {
      parameter.field->read(&settings, YAML::Node(text_of(values[i].value, *parameter.field)), {});
      continue;
    }
    const auto list = lists.try_emplace(parameter.field, numbers_of(parameter.field->default_text)).first;
    list->second.at(*parameter.element) = values[i].value;
  }
  for (const auto& [field, numbers] : lists) field->read(&settings, YAML::Node(numbers), {});
}

}  // namespace dsdpv1::capi

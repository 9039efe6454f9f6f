// Generates the JSON Schema from the description of the keys. Every mapping becomes a separate definition; those of
// another kind of chip contain its name.
#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <utility>

#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::scenario {
namespace {

using Json = nlohmann::ordered_json;
using keys::Choice;
using keys::Field;
using keys::Kind;
using keys::Object;

/// In front of the names of a kind's definitions.
std::string prefix_of(const ChipKind& kind) {
  return &kind == chip_kinds().front() ? "" : std::string(kind.name()) + ".";
}

/// A mapping whose key `chip` names this kind.
Json is_of(const ChipKind& kind) {
  const Json chip = {{"properties", {{"kind", {{"const", kind.name()}}}}}, {"required", {"kind"}}};
  return {{"properties", {{"chip", chip}}}, {"required", {"chip"}}};
}

class SchemaWriter {
 public:
  /// `prefix` for the names of definitions.
  explicit SchemaWriter(std::string prefix) : prefix_(std::move(prefix)) {}

  const Json& definitions() const { return definitions_; }

  Json reference(const Object& described) {
    const std::string id = definition_name(described);
    if (!definitions_.contains(id)) {
      definitions_[id] = nullptr;  // reserves the place while its parts are written
      definitions_[id] = object(described);
    }
    return {{"$ref", "#/$defs/" + id}};
  }

 private:
  std::string definition_name(const Object& object) const {
    std::string text = prefix_ + object.name;
    for (char& c : text) c = c == ' ' ? '_' : c;
    return text;
  }

  Json value(const Field& field) {
    switch (field.type.kind) {
      case Kind::kInteger: return integer(field);
      case Kind::kNumber:
        return {{"type", "number"}, {"minimum", field.type.range.min}, {"maximum", field.type.range.max}};
      case Kind::kBoolean: return {{"type", "boolean"}};
      case Kind::kText: return text(field);
      case Kind::kFile: return {{"type", "string"}, {"minLength", 1}};
      case Kind::kWord: return words(field);
      case Kind::kTime: return {{"type", "string"}, {"pattern", "^-?[0-9]+([.][0-9]+)? *(s|ms|us|ns|cycles)$"}};
      case Kind::kBytes: return bytes(field);
      case Kind::kObject: return reference(*field.type.object);
      case Kind::kList: return list(field);
    }
    return {};
  }

  static Json text(const Field& field) {
    Json json = {{"type", "string"}, {"minLength", 1}};
    if (field.type.range.max > 0) json["maxLength"] = field.type.range.max;
    return json;
  }

  static Json integer(const Field& field) {
    Json json;
    json["anyOf"] = {{{"type", "integer"}, {"minimum", field.type.range.min}, {"maximum", field.type.range.max}},
                     {{"type", "string"}, {"pattern", "^0[xX][0-9A-Fa-f]+$"}}};
    return json;
  }

  static Json words(const Field& field) {
    Json json;
    json["enum"] = Json::array();
    for (const keys::Word& word : field.type.words) json["enum"].push_back(word.text);
    return json;
  }

  static Json bytes(const Field& field) {
    Json json;
    Json items = {{"type", "integer"}, {"minimum", 0}, {"maximum", 255}};
    json["anyOf"] = {
        {{"type", "string"}, {"pattern", "^ *([0-9A-Fa-f]{2}([*][0-9]{1,3})?( +|$))*$"}},
        {{"type", "array"}, {"items", items}, {"minItems", field.type.range.min}, {"maxItems", field.type.range.max}}};
    if (!field.type.words.empty()) json["anyOf"].push_back(words(field));
    return json;
  }

  Json list(const Field& field) {
    Json json = {{"type", "array"}, {"minItems", field.type.range.min}, {"maxItems", field.type.range.max}};
    json["items"] = element(field);
    if (!field.type.words.empty()) json = {{"anyOf", {json, words(field)}}};
    return json;
  }

  Json element(const Field& field) {
    if (field.type.choose) return of_named_kind(*field.type.object);
    if (field.type.object != nullptr) return reference(*field.type.object);
    if (field.type.element == Kind::kInteger)
      return {{"type", "integer"}, {"minimum", field.type.each.min}, {"maximum", field.type.each.max}};
    return {{"type", "string"}, {"minLength", 1}};
  }

  /// The object of the kind that the mapping names, else of this one.
  Json of_named_kind(const Object& described) {
    Json choice = reference(described);
    for (const ChipKind* kind : chip_kinds())
      choice = {
          {"if", is_of(*kind)}, {"then", {{"$ref", "#/$defs/" + prefix_of(*kind) + described.name}}}, {"else", choice}};
    return choice;
  }

  Json property(const Field& field) {
    Json json = value(field);
    json["description"] =
        field.doc + (field.default_text.empty() || field.required ? "" : " Default: " + field.default_text + ".");
    return json;
  }

  Json object(const Object& described) {
    if (!described.selector.empty()) return choices(described);
    std::vector<std::string> required;
    Json json = frame(described);
    for (const Field& field : described.fields) {
      json["properties"][field.name] = property(field);
      if (field.required) required.push_back(field.name);
    }
    if (!required.empty()) json["required"] = required;
    add_groups(described, json);
    return json;
  }

  static Json frame(const Object& described) {
    Json json;
    json["type"] = "object";
    json["description"] = described.doc;
    json["additionalProperties"] = false;
    json["properties"] = Json::object();
    return json;
  }

  /// One alternative for each word of the selector.
  Json choices(const Object& described) {
    Json json = {{"description", described.doc}, {"oneOf", Json::array()}};
    for (const Choice& choice : described.choices) json["oneOf"].push_back(alternative(described, choice));
    return json;
  }

  Json alternative(const Object& described, const Choice& choice) {
    Json json = frame(described);
    json["description"] = choice.doc;
    json["properties"][described.selector] = {{"const", choice.word}};
    for (const auto* group : {&described.always, &choice.required, &choice.optional})
      for (const std::string& key : *group) json["properties"][key] = property(*described.find(key));
    std::vector<std::string> required = choice.required;
    required.push_back(described.selector);
    json["required"] = required;
    add_groups(described, json);
    return json;
  }

  static Json any_of(const std::vector<std::string>& keys) {
    Json json = Json::array();
    for (const std::string& key : keys) json.push_back({{"required", {key}}});
    return json;
  }

  static void add_groups(const Object& described, Json& json) {
    for (const auto& group : described.exactly_one) json["oneOf"] = any_of(group);
    for (const auto& group : described.at_least_one) json["anyOf"] = any_of(group);
    for (const auto& group : described.at_most_one) json["not"] = {{"required", group}};
  }

  std::string prefix_;
  Json definitions_ = Json::object();
};

Json definitions_of(const ChipKind& kind, const std::string& prefix) {
  SchemaWriter writer(prefix);
  writer.reference(description(kind));
  return writer.definitions();
}

Json scenario_of(const std::string& prefix) { return {{"$ref", "#/$defs/" + prefix + "scenario"}}; }

}  // namespace

std::string json_schema() {
  const ChipKind* usual = chip_kinds().front();
  Json definitions = definitions_of(*usual, ""), choice = scenario_of("");
  for (const ChipKind* kind : chip_kinds()) {
    if (kind == usual) continue;
    const std::string prefix = prefix_of(*kind);
    definitions.update(definitions_of(*kind, prefix));
    choice = {{"if", is_of(*kind)}, {"then", scenario_of(prefix)}, {"else", choice}};
  }
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "dsdpv1-sim scenario"}};
  schema.update(choice);
  schema["$defs"] = definitions;
  return schema.dump(2) + "\n";
}

}  // namespace dsdpv1::tb::scenario

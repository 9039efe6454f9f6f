#include "tb/report/fields.hpp"

#include <fmt/format.h>

#include <cstring>

namespace dsdpv1::tb {
namespace {

using Json = Fields::Json;

std::string type_name(const Json& schema) {
  if (schema.contains("const")) return schema["const"].dump();
  if (schema.contains("enum")) return "one word";
  if (!schema["type"].is_array()) return schema["type"];
  return schema["type"][0].get<std::string>() + " or null";
}

void add_rows(const Json& schema, const std::string& path, std::string& rows) {
  if (schema.contains("items")) return add_rows(schema["items"], path + "[]", rows);
  if (!schema.contains("properties")) return;
  for (const auto& [name, each] : schema["properties"].items()) {
    std::string what = each["description"];
    if (each.contains("enum"))
      for (const Json& word : each["enum"])
        what += (word == each["enum"].front() ? ": " : ", ") + word.get<std::string>();
    std::string here = path.empty() ? "" : path + ".";
    here += name;
    rows += fmt::format("| `{}` | {} | {} |\n", here, type_name(each), what);
    add_rows(each, here, rows);
  }
}

}  // namespace

void to_json(Json& json, const Nanoseconds& time) {
  if (time.ticks % bus::kTicksPerNs == 0)
    json = time.ticks / bus::kTicksPerNs;
  else
    json = static_cast<double>(time.ticks) / static_cast<double>(bus::kTicksPerNs);
}

void Fields::word(const char* name, const char* value, std::initializer_list<const char*> words, const char* doc) {
  if (describes_) return member(name, {{"enum", std::vector<const char*>(words)}, {"description", doc}});
  member(name, value);
}

void Fields::constant(const char* name, const char* value, const char* doc) {
  if (describes_) return member(name, {{"const", value}, {"description", doc}});
  member(name, value);
}

void Fields::texts(const char* name, const std::vector<std::string>& values, const char* each, const char* doc) {
  member(name, describes_ ? list_of(plain("string", each), doc) : Json(values));
}

void Fields::counts(const char* name, const Json& counts, const char* each, const char* doc) {
  member(name, describes_ ? any_names(plain("integer", each), doc) : counts);
}

void Fields::groups(const char* name, const Json& groups, const char* each, const char* group, const char* doc) {
  if (describes_) return member(name, or_null(any_names(any_names(plain("integer", each), group), doc)));
  member(name, groups);
}

Json Fields::plain(const char* type, const char* doc) {
  Json schema = {{"type", type}, {"description", doc}};
  if (std::strcmp(type, "integer") == 0) schema["minimum"] = 0;
  return schema;
}

Json Fields::or_null(Json schema) {
  schema["type"] = {schema["type"], "null"};
  return schema;
}

Json Fields::list_of(const Json& each, const char* doc) {
  return {{"type", "array"}, {"description", doc}, {"items", each}};
}

Json Fields::any_names(const Json& each, const char* doc) {
  return {{"type", "object"}, {"description", doc}, {"additionalProperties", each}};
}

void Fields::member(const char* name, Json json, bool always) {
  members_[name] = std::move(json);
  if (always && describes_) required_.push_back(name);
}

Json Fields::schema(const char* doc) const {
  return {{"type", "object"},
          {"description", doc},
          {"additionalProperties", false},
          {"required", required_},
          {"properties", members_}};
}

std::string json_file(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

std::string schema_file(const char* title, const Json& described) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(described);
  return schema.dump(2) + "\n";
}

std::string schema_table(const Json& described) {
  std::string rows = "| member | type | what |\n|---|---|---|\n";
  add_rows(described, "", rows);
  return rows;
}

}  // namespace dsdpv1::tb

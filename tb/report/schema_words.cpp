#include "tb/report/schema_words.hpp"

#include <fmt/format.h>

namespace dsdpv1::tb::schema {
namespace {

Json of(const char* type, const char* doc) { return {{"type", type}, {"description", doc}}; }

std::string type_of(const Json& schema) {
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
    rows += fmt::format("| `{}` | {} | {} |\n", here, type_of(each), what);
    add_rows(each, here, rows);
  }
}

}  // namespace

Json text(const char* doc) { return of("string", doc); }
Json boolean(const char* doc) { return of("boolean", doc); }
Json number(const char* doc) { return of("number", doc); }

Json count(const char* doc) {
  Json json = of("integer", doc);
  json["minimum"] = 0;
  return json;
}

Json or_null(Json json) {
  json["type"] = {json["type"], "null"};
  return json;
}

Json constant(const char* value, const char* doc) { return {{"const", value}, {"description", doc}}; }

Json one_of(const std::vector<const char*>& words, const char* doc) { return {{"enum", words}, {"description", doc}}; }

Json object(const std::vector<Member>& members, const char* doc) {
  Json json = of("object", doc);
  json["additionalProperties"] = false;
  json["required"] = Json::array();
  for (const Member& each : members) {
    json["properties"][each.name] = each.schema;
    if (each.always) json["required"].push_back(each.name);
  }
  return json;
}

Json named(const Json& each, const char* doc) {
  Json json = of("object", doc);
  json["additionalProperties"] = each;
  return json;
}

Json list(const Json& items, const char* doc) {
  Json json = of("array", doc);
  json["items"] = items;
  return json;
}

std::string document(const char* title, const Json& root) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(root);
  return schema.dump(2) + "\n";
}

std::string rows(const Json& root) {
  std::string text;
  add_rows(root, "", text);
  return text;
}

}  // namespace dsdpv1::tb::schema

#pragma once
// The words that JSON Schemas (draft 2020-12) of this program's files are made of, and tables for people made from
// them.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dsdpv1::tb::schema {

using Json = nlohmann::ordered_json;

struct Member {
  std::string name;
  Json schema;
  bool always = true;
};

// Each takes what the value is, in words, last.
Json text(const char* doc);
Json boolean(const char* doc);
Json number(const char* doc);
/// A whole number from 0 on.
Json count(const char* doc);
/// One text only.
Json constant(const char* value, const char* doc);
Json one_of(const std::vector<const char*>& words, const char* doc);
/// Exact: a member that is not named is wrong.
Json object(const std::vector<Member>& members, const char* doc);
/// An object whose members have any names, and all of them this value.
Json named(const Json& each, const char* doc);
Json list(const Json& items, const char* doc);
/// The same, or null.
Json or_null(Json json);

/// The whole schema: `root` is an object.
std::string document(const char* title, const Json& root);
/// Rows of a Markdown table: member, type, what. Members of members have the path of both, `a.b`, of lists `a[].b`.
std::string rows(const Json& root);

}  // namespace dsdpv1::tb::schema

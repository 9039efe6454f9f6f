#pragma once
// The members of a result file, listed once: a function visits the fields of a value. That visit makes the JSON of a
// value, its JSON Schema (draft 2020-12), and a table for people.
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bus/time.hpp"

namespace dsdpv1::tb {

/// A time that is written in nanoseconds: a whole number where it is whole.
struct Nanoseconds {
  bus::Tick ticks = 0;
};
void to_json(nlohmann::ordered_json& json, const Nanoseconds& time);

/// The value, or nothing: null in the file.
template <class V>
std::optional<V> only_if(bool there, V value) {
  return there ? std::optional<V>(std::move(value)) : std::nullopt;
}

/// Takes the fields of a value one after the other, each with its name, and in words what it is.
class Fields {
 public:
  using Json = nlohmann::ordered_json;
  /// Says the fields of a value; also of a fresh V, from which the schema is made.
  template <class V>
  using Visit = void (*)(Fields& out, const V& value);

  template <class V>
  static Json written(const V& value, Visit<V> visit) {
    Fields fields(false);
    visit(fields, value);
    return std::move(fields.members_);
  }
  /// The schema of any V. It is exact: a member that is not named is wrong.
  template <class V>
  static Json described(Visit<V> visit, const char* doc) {
    Fields fields(true);
    visit(fields, V{});
    return fields.schema(doc);
  }

  /// A boolean, a whole number from 0 on, a number, Nanoseconds or a text.
  template <class V>
  void field(const char* name, const V& value, const char* doc) {
    member(name, describes_ ? plain(type_of<V>(), doc) : Json(value));
  }
  /// The same, or null.
  template <class V>
  void field(const char* name, const std::optional<V>& value, const char* doc) {
    if (describes_) return member(name, or_null(plain(type_of<V>(), doc)));
    member(name, value ? Json(*value) : Json());
  }
  void time(const char* name, bus::Tick value, const char* doc) { field(name, Nanoseconds{value}, doc); }
  void time(const char* name, const std::optional<bus::Tick>& value, const char* doc) {
    field(name, only_if(value.has_value(), Nanoseconds{value.value_or(0)}), doc);
  }
  /// One of some words.
  void word(const char* name, const char* value, std::initializer_list<const char*> words, const char* doc);
  /// This text and no other.
  void constant(const char* name, const char* value, const char* doc);

  template <class V>
  void object(const char* name, const V& value, Visit<V> visit, const char* doc) {
    member(name, describes_ ? described(visit, doc) : written(value, visit));
  }
  /// Null where there is none. `value`: an optional, or a pointer.
  template <class P, class V>
  void object_or_null(const char* name, const P& value, Visit<V> visit, const char* doc) {
    if (describes_) return member(name, or_null(described(visit, doc)));
    member(name, value ? written(*value, visit) : Json());
  }
  /// Left out where there is none.
  template <class P, class V>
  void object_if(const char* name, const P& value, Visit<V> visit, const char* doc) {
    if (describes_) return member(name, described(visit, doc), false);
    if (value) member(name, written(*value, visit));
  }
  /// `each`: what one of its objects is.
  template <class List, class V>
  void list(const char* name, const List& values, Visit<V> visit, const char* each, const char* doc) {
    if (describes_) return member(name, list_of(described(visit, each), doc));
    Json items = Json::array();
    for (const V& value : values) items.push_back(written(value, visit));
    member(name, std::move(items));
  }
  void texts(const char* name, const std::vector<std::string>& values, const char* each, const char* doc);
  /// `counts`: an object with numbers under any names.
  void counts(const char* name, const Json& counts, const char* each, const char* doc);
  /// `groups`: null, or an object of such objects.
  void groups(const char* name, const Json& groups, const char* each, const char* group, const char* doc);

 private:
  explicit Fields(bool describes) : describes_(describes) {}

  template <class V>
  static constexpr const char* type_of() {
    if constexpr (std::is_same_v<V, bool>) return "boolean";
    if constexpr (std::is_integral_v<V>) return "integer";
    if constexpr (std::is_floating_point_v<V> || std::is_same_v<V, Nanoseconds>) return "number";
    static_assert(std::is_arithmetic_v<V> || std::is_same_v<V, Nanoseconds> || std::is_convertible_v<V, std::string>);
    return "string";
  }
  static Json plain(const char* type, const char* doc);
  static Json or_null(Json schema);
  static Json list_of(const Json& each, const char* doc);
  static Json any_names(const Json& each, const char* doc);
  /// `json`: its value, or its schema.
  void member(const char* name, Json json, bool always = true);
  Json schema(const char* doc) const;

  bool describes_;
  Json members_ = Json::object();
  Json required_ = Json::array();
};

/// The file: indented, with a line end.
std::string json_file(const Fields::Json& json);
/// The whole schema of a file whose member "schema" is `title`.
std::string schema_file(const char* title, const Fields::Json& described);
/// A Markdown table: member, type, what. Members of members have the path of both, `a.b`, of lists `a[].b`.
std::string schema_table(const Fields::Json& described);

}  // namespace dsdpv1::tb

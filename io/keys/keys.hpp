#pragma once
// One description of a scenario's keys. From it come the parser, the JSON Schema and docs/scenarios.md, so that the
// three cannot disagree. An `Object` is a mapping with fields; `ObjectOf<T>` binds its fields to the members of a
// struct.
#include <yaml-cpp/yaml.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bus/bytes.hpp"
#include "bus/time.hpp"

namespace dsdpv1::tb::keys {

enum class Kind : std::uint8_t { kInteger, kNumber, kBoolean, kText, kFile, kWord, kTime, kBytes, kObject, kList };

/// Least and greatest allowed value: of an integer, of a time in ticks, of the number of bytes, items or (0: any)
/// characters.
struct Range {
  std::int64_t min = 0, max = 0;
};

/// One allowed word of a `kWord` value.
struct Word {
  std::string text, doc;
};

struct Object;

/// The file being read: where its errors point to.
struct Source {
  std::string file;
};

/// The type of a value.
struct Type {
  Kind kind = Kind::kText;
  Range range;
  std::string unit;                ///< of an integer or number, for people
  std::vector<Word> words;         ///< of a kWord; of a kList or kBytes: words that replace it
  Kind element = Kind::kObject;    ///< of a kList
  Range each;                      ///< of the elements of a kList of integers
  const Object* object = nullptr;  ///< of a kObject, or of the elements of a kList; outlives the Type
  /// Where elements of a kList differ: the object of this one, which outlives the Type; null: always `object`.
  std::function<const Object&(const YAML::Node& node, const Source& source)> choose = nullptr;

  const Object& object_of(const YAML::Node& node, const Source& source) const {
    return choose ? choose(node, source) : *object;
  }
};

struct Field {
  std::string name;
  Type type;
  std::string doc;
  std::string default_text;  ///< as a scenario would write it; empty when leaving the key out means "none"
  bool required = false;
  std::function<void(void* owner, const YAML::Node& node, const Source& source)> read;
};

/// One word of an object's selector, with the fields that it needs and takes.
struct Choice {
  std::string word, doc;
  std::vector<std::string> required, optional;
};

/// A key in a mapping of the scenario, from the file or the command line.
struct Given {
  std::string key;
  int line = 0;
  std::string option;  ///< of the command line, "--set user_cpu.cycle=40us"; empty: from the file
};

/// Tag of nodes that the command line has put into a scenario's YAML, followed by the option.
constexpr const char* kOptionTag = "!option ";
/// The option that has put the node there; empty for nodes of the file.
std::string option_of(const YAML::Node& node);

struct Object {
  using SetLine = std::function<void(void* owner, int line)>;
  using NoteKey = std::function<void(void* owner, Given given)>;

  Object(std::string object_name, std::string object_doc, SetLine line_setter)
      : name(std::move(object_name)), doc(std::move(object_doc)), set_line(std::move(line_setter)) {}

  std::string name, doc;
  std::vector<Field> fields;
  std::string selector;  ///< name of the field whose word decides which fields may be there; empty: all may
  std::vector<Choice> choices;
  std::vector<std::string> always;                     ///< fields outside the choices, when there is a selector
  std::vector<std::vector<std::string>> exactly_one;   ///< exactly one field of each group must be there
  std::vector<std::vector<std::string>> at_most_one;   ///< no two fields of a group together
  std::vector<std::vector<std::string>> at_least_one;  ///< at least one field of each group must be there
  SetLine set_line;
  NoteKey note_key;  ///< null: keys are not noted

  const Field* find(const std::string& key) const;
};

/// A name or path in a scenario with its line, for later checks.
struct Name {
  std::string text;
  int line = 0;
  bool empty() const { return text.empty(); }
};

// Reading of one value; each throws InputError with the allowed values.
std::int64_t read_integer(const Field& field, const YAML::Node& node, const Source& source);
double read_number(const Field& field, const YAML::Node& node, const Source& source);
bool read_boolean(const Field& field, const YAML::Node& node, const Source& source);
std::string read_text(const Field& field, const YAML::Node& node, const Source& source);
std::size_t read_word(const Field& field, const YAML::Node& node, const Source& source);
bus::Tick read_time(const Field& field, const YAML::Node& node, const Source& source);
bus::Bytes read_bytes(const Field& field, const YAML::Node& node, const Source& source);
void read_object(const Object& object, void* owner, const YAML::Node& node, const Source& source);
/// True when it is one of the field's words.
bool is_word_of(const Field& field, const YAML::Node& node);
/// Checks that `node` is a list of an allowed length.
void check_list(const Field& field, const YAML::Node& node, const Source& source);
int line_of(const YAML::Node& node);

/// Structs with a member `given` store the keys of their mapping.
template <class T, class = void>
struct KeepsKeys : std::false_type {};
template <class T>
struct KeepsKeys<T, std::void_t<decltype(T::given)>> : std::true_type {};

template <class M>
struct IsOptional : std::false_type {};
template <class V>
struct IsOptional<std::optional<V>> : std::true_type {};

template <class M>
struct ValueOf {
  using type = M;
};
template <class V>
struct ValueOf<std::optional<V>> {
  using type = V;
};

std::string default_text(std::int64_t value);
std::string default_number(double value);
std::string default_time(bus::Tick value);

/// An enumerator and the word for it.
template <class E>
struct WordFor {
  E value;
  const char* text;
  const char* doc;
};

/// Describes the struct T. The default of a field is the value that the member has in a fresh T; a member that is
/// std::optional has none.
template <class T>
class ObjectOf : public Object {
 public:
  ObjectOf(std::string object_name, std::string object_doc)
      : Object(std::move(object_name), std::move(object_doc),
               [](void* owner, int line) { static_cast<T*>(owner)->line = line; }) {
    if constexpr (KeepsKeys<T>::value)
      note_key = [](void* owner, Given given) { static_cast<T*>(owner)->given.push_back(std::move(given)); };
  }

  template <class M, class B>
  Field& integer(const char* key, M B::*member, Range range, const char* unit, const char* text) {
    using V = typename ValueOf<M>::type;
    Field& field = add(key, Kind::kInteger, text);
    field.type.range = range;
    field.type.unit = unit;
    if constexpr (!IsOptional<M>::value) field.default_text = default_text(static_cast<std::int64_t>(T{}.*member));
    return on_read(field, [member](T& owner, const Field& self, const YAML::Node& node, const Source& source) {
      owner.*member = static_cast<V>(read_integer(self, node, source));
    });
  }

  template <class M, class B>
  Field& number(const char* key, M B::*member, Range range, const char* unit, const char* text) {
    Field& field = add(key, Kind::kNumber, text);
    field.type.range = range;
    field.type.unit = unit;
    if constexpr (!IsOptional<M>::value) field.default_text = default_number(T{}.*member);
    return on_read(field, [member](T& owner, const Field& self, const YAML::Node& node, const Source& source) {
      owner.*member = read_number(self, node, source);
    });
  }

  template <class M, class B>
  Field& boolean(const char* key, M B::*member, const char* text) {
    Field& field = add(key, Kind::kBoolean, text);
    if constexpr (!IsOptional<M>::value) field.default_text = T{}.*member ? "true" : "false";
    return on_read(field, [member](T& owner, const Field& self, const YAML::Node& node, const Source& source) {
      owner.*member = read_boolean(self, node, source);
    });
  }

  /// So many integers as the member has elements, each within `each`.
  template <class V, std::size_t N, class B>
  Field& integers(const char* key, std::array<V, N> B::*member, Range each, const char* unit, const char* text) {
    Field& field = add(key, Kind::kList, text);
    field.type.element = Kind::kInteger;
    field.type.range = {static_cast<std::int64_t>(N), static_cast<std::int64_t>(N)};
    field.type.each = each;
    field.type.unit = unit;
    const T fresh{};
    for (const V value : fresh.*member)
      field.default_text += (field.default_text.empty() ? "[" : ", ") + default_text(value);
    field.default_text += ']';
    return on_read(field, [member](T& owner, const Field& self, const YAML::Node& node, const Source& source) {
      check_list(self, node, source);
      Field element = self;
      element.type.range = self.type.each;
      for (std::size_t i = 0; i < N; ++i) (owner.*member)[i] = static_cast<V>(read_integer(element, node[i], source));
    });
  }

  /// Times from `range.min` to `range.max` ticks.
  template <class M, class B>
  Field& time(const char* key, M B::*member, Range range, const char* text) {
    Field& field = add(key, Kind::kTime, text);
    field.type.range = range;
    if constexpr (!IsOptional<M>::value) field.default_text = default_time(T{}.*member);
    return on_read(field, [member](T& owner, const Field& self, const YAML::Node& node, const Source& source) {
      owner.*member = read_time(self, node, source);
    });
  }

  /// A name (with its line) or plain text.
  template <class B>
  Field& name_of(const char* key, Name B::*member, const char* text) {
    return named(key, member, Kind::kText, text);
  }
  /// A path, relative to the folder of the scenario.
  Field& file(const char* key, Name T::*member, const char* text) { return named(key, member, Kind::kFile, text); }

  /// At most `most` characters, 0: any number.
  template <class B>
  Field& text(const char* key, std::string B::*member, const char* text, std::int64_t most = 0) {
    Field& field = add(key, Kind::kText, text);
    field.type.range.max = most;
    field.default_text = T{}.*member;
    return on_read(field, [member](T& owner, const Field& self, const YAML::Node& node, const Source& source) {
      owner.*member = read_text(self, node, source);
    });
  }

  template <class M, class B, class E>
  Field& word(const char* key, M B::*member, std::vector<WordFor<E>> words, const char* text) {
    Field& field = add(key, Kind::kWord, text);
    const T fresh{};
    for (const WordFor<E>& each : words) {
      field.type.words.push_back({each.text, each.doc});
      if constexpr (!IsOptional<M>::value) {
        if (fresh.*member == each.value) field.default_text = each.text;
      }
    }
    return on_read(field, [member, words = std::move(words)](T& owner, const Field& self, const YAML::Node& node,
                                                             const Source& source) {
      owner.*member = words[read_word(self, node, source)].value;
    });
  }

  /// `lengths` limits the number of bytes. The member is bus::Bytes or an optional of it.
  template <class M, class B>
  Field& bytes(const char* key, M B::*member, Range lengths, const char* text) {
    Field& field = add(key, Kind::kBytes, text);
    field.type.range = lengths;
    return on_read(field, [member](T& owner, const Field& self, const YAML::Node& node, const Source& source) {
      owner.*member = read_bytes(self, node, source);
    });
  }

  /// Bytes, or instead one of `words`, which sets `choice`.
  template <class E>
  Field& bytes_or(const char* key, bus::Bytes T::*member, Range lengths, std::vector<WordFor<E>> words, E T::*choice,
                  const char* text) {
    Field& field = bytes(key, member, lengths, text);
    for (const WordFor<E>& each : words) field.type.words.push_back({each.text, each.doc});
    const auto read_plain = field.read;
    return on_read(field, [choice, read_plain, words = std::move(words)](T& owner, const Field& self,
                                                                         const YAML::Node& node, const Source& source) {
      if (!is_word_of(self, node)) return read_plain(&owner, node, source);
      owner.*choice = words[read_word(self, node, source)].value;
    });
  }

  /// The member is U or an optional of U; a key left out leaves a plain member with U's defaults.
  template <class M, class B, class U>
  Field& object(const char* key, M B::*member, const ObjectOf<U>& described, const char* text) {
    Field& field = add(key, Kind::kObject, text);
    field.type.object = &described;
    return on_read(field, [member, &described](T& owner, const Field&, const YAML::Node& node, const Source& source) {
      U value{};
      read_object(described, &value, node, source);
      owner.*member = std::move(value);
    });
  }

  /// `choose`: see Type; each object it returns describes U.
  template <class U>
  Field& list(const char* key, std::vector<U> T::*member, const ObjectOf<U>& described, Range items, const char* text,
              std::function<const Object&(const YAML::Node&, const Source&)> choose = nullptr) {
    Field& field = add(key, Kind::kList, text);
    field.type.object = &described;
    field.type.range = items;
    field.type.choose = std::move(choose);
    return on_read(field, [member](T& owner, const Field& self, const YAML::Node& node, const Source& source) {
      check_list(self, node, source);
      for (const YAML::Node& item : node) {
        (owner.*member).emplace_back();
        read_object(self.type.object_of(item, source), &(owner.*member).back(), item, source);
      }
    });
  }

  /// A list, or instead `word`, which makes `flag` false.
  template <class U>
  Field& list_or(const char* key, std::vector<U> T::*member, const ObjectOf<U>& described, Range items,
                 const Word& word, bool T::*flag, const char* text) {
    Field& field = list(key, member, described, items, text);
    field.type.words = {word};
    const auto read_list = field.read;
    return on_read(field, [flag, read_list](T& owner, const Field& self, const YAML::Node& node, const Source& source) {
      if (is_word_of(self, node)) {
        owner.*flag = false;
        return;
      }
      check_list(self, node, source);  // which knows of the word
      read_list(&owner, node, source);
    });
  }

  Field& names(const char* key, std::vector<Name> T::*member, Range items, const char* text) {
    Field& field = add(key, Kind::kList, text);
    field.type.element = Kind::kText;
    field.type.range = items;
    return on_read(field, [member](T& owner, const Field& self, const YAML::Node& node, const Source& source) {
      check_list(self, node, source);
      for (const YAML::Node& item : node) (owner.*member).push_back({read_text(self, item, source), line_of(item)});
    });
  }

 private:
  Field& add(const char* key, Kind kind, const char* text) {
    fields.emplace_back();
    fields.back().name = key;
    fields.back().type.kind = kind;
    fields.back().doc = text;
    return fields.back();
  }

  template <class B>
  Field& named(const char* key, Name B::*member, Kind kind, const char* text) {
    Field& field = add(key, kind, text);
    return on_read(field, [member](T& owner, const Field& self, const YAML::Node& node, const Source& source) {
      owner.*member = Name{read_text(self, node, source), line_of(node)};
    });
  }

  /// Fields move while others are added, so the reader gets a copy of the data that it needs.
  template <class Read>
  Field& on_read(Field& field, Read read) {
    field.read = [self = field, read = std::move(read)](void* owner, const YAML::Node& node, const Source& source) {
      read(*static_cast<T*>(owner), self, node, source);
    };
    return field;
  }
};

}  // namespace dsdpv1::tb::keys

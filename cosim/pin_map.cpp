#include "cosim/pin_map.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <system_error>

#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "io/input/suggest.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr int kLargestTolerance = 1000;

const std::vector<std::string>& known_keys() {
  static const std::vector<std::string> keys = {"clock",     "pins",      "tie",        "fault",
                                                "tolerance", "chip",      "parameters", "defines",
                                                "files",     "file_list", "include",    "reference"};
  return keys;
}

class Reader {
 public:
  Reader(std::string path, const tb::PinTable& pins, std::vector<std::string> parameters)
      : path_(std::move(path)), pins_(pins), parameters_(std::move(parameters)), map_(default_pin_map(pins)) {
    map_.path = path_;
  }

  PinMap read(const std::string& content) {
    const YAML::Node root = load(content);
    check_keys(root, known_keys());
    for (const char* key : {"pins", "tie", "tolerance", "chip", "parameters", "defines"}) check_map(key, root[key]);
    for (const char* key : {"files", "include"})
      if (root[key] && !root[key].IsSequence())
        fail(root[key], std::string(key) + " is no list, expected [NAME, NAME]");
    if (root["clock"]) map_.clock = port("clock", root["clock"]);
    for (const auto& each : root["pins"]) pin(each.first, each.second);
    for (const auto& each : root["tie"]) tie(each.first, each.second);
    if (const YAML::Node fault = root["fault"]) map_.fault = {identifier("fault", fault), line_of(fault)};
    for (const auto& each : root["tolerance"]) tolerance(each.first, each.second);
    for (const auto& each : root["parameters"])
      map_.parameters[identifier("a parameter", each.first)] = {word("parameter " + each.first.Scalar(), each.second),
                                                                line_of(each.first)};
    for (const auto& each : root["chip"]) place(each.first, each.second);
    for (const auto& each : root["defines"]) define(each.first, each.second);
    for (const auto& each : root["files"]) map_.files.push_back({word("a file", each), line_of(each)});
    for (const auto& each : root["include"]) map_.include.push_back({word("a folder", each), line_of(each)});
    if (const YAML::Node list = root["file_list"]) map_.file_list = {word("file_list", list), line_of(list)};
    if (root["reference"]) map_.reference = truth("reference", root["reference"]);
    return map_;
  }

 private:
  static int line_of(const YAML::Node& node) { return node.Mark().line + 1; }
  [[noreturn]] void fail(const YAML::Node& at, const std::string& what) const {
    throw tb::InputError(path_, line_of(at), what);
  }
  YAML::Node load(const std::string& content) const {
    try {
      YAML::Node root = YAML::Load(content);
      if (!root.IsMap() && !root.IsNull()) fail(root, "is no map, expected " + tb::join(known_keys()));
      return root;
    } catch (const YAML::ParserException& error) {
      throw tb::InputError(path_, error.mark.line + 1, error.msg + ", expected YAML");
    }
  }
  /// `what` it is, for messages.
  std::string word(const std::string& what, const YAML::Node& node) const {
    if (!node.IsScalar() || node.Scalar().empty()) fail(node, what + " is no word, expected one name or number");
    return node.Scalar();
  }
  /// A name of a module's port, parameter or macro: it is used in commands and in generated code.
  std::string identifier(const std::string& what, const YAML::Node& node) const {
    const std::string name = word(what, node);
    const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$'; };
    if (std::isdigit(static_cast<unsigned char>(name.front())) != 0 || !std::all_of(name.begin(), name.end(), fits))
      fail(node, what + " is " + name + ", expected a name: letters, digits, _ and $");
    return name;
  }
  void check_keys(const YAML::Node& node, const std::vector<std::string>& allowed) const {
    for (const auto& each : node) check_name(each.first, allowed);
    check_once(node);
  }
  void check_map(const std::string& key, const YAML::Node& node) const {
    if (!node) return;
    if (!node.IsMap()) fail(node, key + " is no map, expected NAME: VALUE");
    check_once(node);
  }
  void check_once(const YAML::Node& node) const {
    std::vector<std::string> seen;
    for (const auto& each : node) {
      const std::string name = word("a key", each.first);
      if (std::find(seen.begin(), seen.end(), name) != seen.end())
        fail(each.first, name + " is there twice, expected it once");
      seen.push_back(name);
    }
  }
  void check_name(const YAML::Node& node, const std::vector<std::string>& allowed) const {
    const std::string name = word("a key", node);
    if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
      fail(node, "unknown name " + name + tb::did_you_mean(name, allowed) + ", expected " + tb::join(allowed));
  }
  Port port(const std::string& pin, const YAML::Node& node) const {
    if (node.IsScalar()) return {identifier(pin, node), false, line_of(node)};
    if (!node.IsMap() || !node["port"]) fail(node, pin + " is no port, expected NAME and {port: NAME, inverted: true}");
    check_keys(node, {"port", "inverted"});
    Port port{identifier("port of " + pin, node["port"]), false, line_of(node)};
    if (node["inverted"]) port.inverted = truth("inverted of " + pin, node["inverted"]);
    return port;
  }
  bool truth(const std::string& what, const YAML::Node& node) const {
    const std::string value = word(what, node);
    if (value != "true" && value != "false") fail(node, what + " is " + value + ", expected true, false");
    return value == "true";
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& [name, unused] : map_.pins) names.push_back(name);
    return names;
  }
  void pin(const YAML::Node& name, const YAML::Node& node) {
    check_name(name, names());
    map_.pins[name.Scalar()] = port(name.Scalar(), node);
  }
  void tie(const YAML::Node& name, const YAML::Node& node) {
    const std::string port = identifier("a port", name);
    map_.ties[port] = {number("tie of " + port, node), line_of(name)};
  }
  /// 5, 0x1F
  std::uint64_t number(const std::string& what, const YAML::Node& node) const {
    const std::string text = word(what, node);
    const bool hex = text.rfind("0x", 0) == 0;
    const std::string digits = hex ? text.substr(2) : text;
    const char* const allowed = hex ? "0123456789abcdefABCDEF" : "0123456789";
    std::uint64_t value = 0;
    if (!digits.empty() && digits.find_first_not_of(allowed) == std::string::npos) {
      const char* const end = digits.data() + digits.size();
      if (std::from_chars(digits.data(), end, value, hex ? 16 : 10).ec == std::errc()) return value;
    }
    fail(node, what + " is " + text + ", expected a number like 1 or 0x1F of at most 64 bits");
  }
  void place(const YAML::Node& key, const YAML::Node& node) {
    if (!parameters_.empty()) check_name(key, parameters_);
    const std::string what = "chip." + key.Scalar();
    if (!node.IsScalar() && (!node.IsMap() || !node["port"]))
      fail(node, what + " is no place in the RTL, expected PARAMETER and {port: INPUT}");
    if (node.IsMap()) check_keys(node, {"port"});
    const bool port = node.IsMap();
    const Place place{identifier(what, port ? node["port"] : node), port, line_of(key)};
    if (!port && map_.parameters.count(place.name) != 0)
      fail(node, place.name + " is also in parameters, expected it once");
    map_.chip[key.Scalar()] = place;
  }
  /// Without a value: defined as nothing.
  void define(const YAML::Node& name, const YAML::Node& node) {
    map_.defines[identifier("a macro", name)] = {node.IsNull() ? "" : word("macro " + name.Scalar(), node),
                                                 line_of(name)};
  }
  void tolerance(const YAML::Node& name, const YAML::Node& node) {
    std::vector<std::string> outputs;
    for (const tb::PinInfo& pin : pins_)
      if (!pin.input && pin.bus == nullptr) outputs.emplace_back(pin.name);
    check_name(name, outputs);
    for (std::size_t i = 0; i < pins_.size(); ++i)
      if (name.Scalar() == pins_[i].name) map_.tolerances.at(i) = cycles("tolerance of " + name.Scalar(), node);
  }
  int cycles(const std::string& what, const YAML::Node& node) const {
    int value = -1;
    if (!YAML::convert<int>::decode(node, value) || value < 0 || value > kLargestTolerance)
      fail(node, what + " is " + word(what, node) + ", expected 0 to " + std::to_string(kLargestTolerance) + " cycles");
    return value;
  }

  std::string path_;
  const tb::PinTable& pins_;
  const std::vector<std::string> parameters_;
  PinMap map_;
};

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::string enable_of(const tb::PinInfo& pin) {
  return pin.released ? std::string(pin.bus != nullptr ? pin.bus : pin.name) + "_OE" : "";
}

PinMap default_pin_map(const tb::PinTable& pins) {
  PinMap map;
  map.clock.name = "clk_i";
  for (const tb::PinInfo& pin : pins) {
    map.pins[pin.name] = {lower(pin.bus != nullptr ? pin.bus : pin.name) + (pin.input ? "_i" : "_o")};
    if (pin.released) map.pins[enable_of(pin)] = {lower(enable_of(pin)) + "_o"};
  }
  return map;
}

PinMap load_pin_map(const std::string& path, const tb::PinTable& pins, const std::vector<std::string>& parameters) {
  return parse_pin_map(tb::read_file(path, tb::kPinMapFile), path, pins, parameters);
}

PinMap parse_pin_map(const std::string& text, const std::string& path, const tb::PinTable& pins,
                     const std::vector<std::string>& parameters) {
  return Reader(path, pins, parameters).read(text);
}

}  // namespace dsdpv1::cosim

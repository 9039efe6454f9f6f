#include "cosim/pin_map.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>

#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "io/input/suggest.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr int kLargestTolerance = 1000;

class Reader {
 public:
  Reader(std::string path, const tb::PinTable& pins)
      : path_(std::move(path)), pins_(pins), map_(default_pin_map(pins)) {}

  PinMap read(const std::string& content) {
    const YAML::Node root = load(content);
    check_keys(root, {"clock", "pins", "tolerance", "parameters", "files", "include", "reference"});
    for (const char* key : {"pins", "tolerance", "parameters"})
      if (root[key] && !root[key].IsMap()) fail(root[key], std::string(key) + " is no map, expected NAME: VALUE");
    for (const char* key : {"files", "include"})
      if (root[key] && !root[key].IsSequence())
        fail(root[key], std::string(key) + " is no list, expected [NAME, NAME]");
    if (root["clock"]) map_.clock = port("clock", root["clock"]);
    for (const auto& each : root["pins"]) pin(each.first, each.second);
    for (const auto& each : root["tolerance"]) tolerance(each.first, each.second);
    for (const auto& each : root["parameters"])
      map_.parameters[word("a parameter", each.first)] = word("parameter " + each.first.Scalar(), each.second);
    for (const auto& each : root["files"]) map_.files.push_back(word("a file", each));
    for (const auto& each : root["include"]) map_.include.push_back(word("a folder", each));
    if (root["reference"]) map_.reference = truth("reference", root["reference"]);
    return map_;
  }

 private:
  [[noreturn]] void fail(const YAML::Node& at, const std::string& what) const {
    throw tb::InputError(path_, at.Mark().line + 1, what);
  }
  YAML::Node load(const std::string& content) const {
    try {
      YAML::Node root = YAML::Load(content);
      if (!root.IsMap() && !root.IsNull())
        fail(root, "is no map, expected clock, pins, tolerance, parameters, files, include, reference");
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
  void check_keys(const YAML::Node& node, const std::vector<std::string>& allowed) const {
    for (const auto& each : node) check_name(each.first, allowed);
  }
  void check_name(const YAML::Node& node, const std::vector<std::string>& allowed) const {
    const std::string name = word("a key", node);
    if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
      fail(node, "unknown name " + name + tb::did_you_mean(name, allowed) + ", expected " + tb::join(allowed));
  }
  Port port(const std::string& pin, const YAML::Node& node) const {
    if (node.IsScalar()) return {word(pin, node), false};
    if (!node.IsMap() || !node["port"]) fail(node, pin + " is no port, expected NAME and {port: NAME, inverted: true}");
    check_keys(node, {"port", "inverted"});
    Port port{word("port of " + pin, node["port"]), false};
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
  map.clock = {"clk_i", false};
  for (const tb::PinInfo& pin : pins) {
    map.pins[pin.name] = {lower(pin.bus != nullptr ? pin.bus : pin.name) + (pin.input ? "_i" : "_o"), false};
    if (pin.released) map.pins[enable_of(pin)] = {lower(enable_of(pin)) + "_o", false};
  }
  return map;
}

PinMap load_pin_map(const std::string& path, const tb::PinTable& pins) {
  return parse_pin_map(tb::read_file(path, tb::kPinMapFile), path, pins);
}

PinMap parse_pin_map(const std::string& text, const std::string& path, const tb::PinTable& pins) {
  return Reader(path, pins).read(text);
}

}  // namespace dsdpv1::cosim

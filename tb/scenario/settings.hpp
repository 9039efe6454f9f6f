#pragma once
// Keys of a scenario given on the command line: `PATH=VALUE` replaces a value of the file before it is read.
#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "io/keys/keys.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::tb::scenario {

/// PATH names a key as in the YAML, its steps joined by points:
///
///   slaves.0.user_cpu.cycle     by number, from 0
///   slaves.plant.init.dpv1      by name, in lists whose items have one
///   user_cpu.fsmc.datast        of every slave, if it begins with a key of a slave that the scenario itself does not
///   have
///
/// Missing mappings on the way are created, items of lists are not. A value shared through an anchor changes in all its
/// places.
struct Setting {
  std::string path, value;
  std::string origin;  ///< prefix of its errors: "--set user_cpu.cycle=40us"
};

/// "PATH=VALUE"; `option` is its name on the command line. Throws InputError.
Setting parse_setting(const std::string& option, const std::string& text);

/// Parses several options --set.
std::vector<Setting> parse_settings(const std::vector<std::string>& texts);

/// The key named by a path, whatever items the scenario has. Throws InputError, beginning with `origin`.
const keys::Field& field_of(const std::string& path, const ChipKind& kind, const std::string& origin);
/// As above if the kind of chip is unknown: uses the first kind that has such a key.
const keys::Field& field_of_any(const std::string& path, const std::string& origin);

/// Throws InputError if no scenario could have the setting; does not check whether an item of a list exists.
void check(const Setting& setting);

/// A path from the command line, relative to the user's working folder, in the scenario's form.
std::string given_path(const std::string& path);

/// Writes the setting into a scenario's YAML. Throws InputError for a wrong path or value.
void apply(const Setting& setting, const ChipKind& kind, YAML::Node& root);

}  // namespace dsdpv1::tb::scenario

#pragma once
// Keys of a scenario given on the command line: `PATH=VALUE` replaces what the file says, before it is read.
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
///   user_cpu.fsmc.datast        of every slave, when it begins with a key of a slave that the scenario itself has not
///
/// Mappings on the way that the file leaves out come into being, items of lists do not. What the file shares through an
/// anchor changes wherever it stands.
struct Setting {
  std::string path, value;
  std::string origin;  ///< what its errors begin with: "--set user_cpu.cycle=40us"
};

/// "PATH=VALUE"; `option` is how the command line calls it. Throws InputError.
Setting parse_setting(const std::string& option, const std::string& text);

/// Those of several options --set.
std::vector<Setting> parse_settings(const std::vector<std::string>& texts);

/// The key that a path names, whatever items the scenario has. Throws InputError, beginning with `origin`.
const keys::Field& field_of(const std::string& path, const ChipKind& kind, const std::string& origin);
/// The same where the kind of chip is not known: that of the first kind that has such a key.
const keys::Field& field_of_any(const std::string& path, const std::string& origin);

/// Throws InputError when no scenario could have the setting; whether it has the item of a list is left open.
void check(const Setting& setting);

/// A path given on a command line, which is relative to where the user stands, as the scenario holds it then.
std::string given_path(const std::string& path);

/// Writes the setting into a scenario's YAML. Throws InputError for a path or value that is wrong.
void apply(const Setting& setting, const ChipKind& kind, YAML::Node& root);

}  // namespace dsdpv1::tb::scenario

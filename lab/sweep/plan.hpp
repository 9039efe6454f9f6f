#pragma once
// The points of a sweep: the product of its parameters' values over one scenario.
#include <cstddef>
#include <string>
#include <vector>

#include "io/keys/keys.hpp"

namespace dsdpv1::tb::sweep {

/// A key of the scenario and its values, in the syntax of `run --set`.
struct Parameter {
  std::string path;
  std::vector<std::string> values;
};

/// "PATH=VALUES" of `option`. VALUES are separated by commas; whole numbers and times may have ranges:
///
///   user_cpu.fsmc.datast=0..15     every whole number from 0 to 15
///   user_cpu.cycle=40us..100us/20us   40us, 60us, 80us, 100us; times need a step
///   baud=12M,6M,500k
///
/// A range includes its end when a step meets it. Throws InputError for a path that no scenario has, a value
/// that the key does not allow, one that is there twice, and more than 10 000 values.
Parameter parse_parameter(const std::string& text, const std::string& option = "--param");

/// A list of values and ranges, each value once. Throws InputError, `origin` is their place.
std::vector<std::string> values_of(keys::Kind kind, const std::string& list, const std::string& origin);

struct Plan {
  std::string scenario;
  std::vector<std::string> settings;  ///< PATH=VALUE, the same at every point
  std::string checks;                 ///< of `run --checks`; empty: its default
  std::vector<Parameter> parameters;

  /// Number of points.
  std::size_t points() const;
  /// The value of each parameter at a point; the last parameter changes fastest.
  std::vector<std::string> values(std::size_t point) const;
  /// PATH=VALUE of all settings of a point.
  std::vector<std::string> settings_of(std::size_t point) const;
  /// "datast": the end of a parameter's path, the whole path if two have the same end.
  std::string short_name(std::size_t parameter) const;
};

/// Throws InputError when a key is set or swept twice, without parameters, and for more than 100 000 points.
void check(const Plan& plan);

}  // namespace dsdpv1::tb::sweep

#pragma once
// The table of what docs/chip.md rules, and the table of its parameters: what pins can show of each.
#include <string>
#include <vector>

#include "io/keys/keys.hpp"
#include "lab/calibrate/found.hpp"

namespace dsdpv1::calibrate {

struct Ruling {
  const char* id;      ///< "S3"; "facts"
  const char* hidden;  ///< why there is no claim; nullptr: `claims` has some
};

/// All of docs/chip.md, in its order.
const std::vector<Ruling>& rulings();
/// All claims, in no order.
Claims all_claims();

struct ParameterRow {
  Parameter parameter;
  const char* key;       ///< in a scenario's `chip`; unit, default and range stand there, its ruling in parameters.inc
  const char* measured;  ///< from what
  std::vector<Wire> needs;
};

const std::vector<ParameterRow>& parameters();
/// Which ruling marks it (p): "H1".
const char* ruling_of(const ParameterRow& row);
/// The scenario's description of it.
const tb::keys::Field& field_of(const ParameterRow& row);
long long default_of(const ParameterRow& row);

}  // namespace dsdpv1::calibrate

#pragma once
// The goldens in their folder: NAME.json, the manifest, and NAME.trace.xz, for the scenario NAME.yaml.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lab/traces/manifest.hpp"
#include "lab/traces/trace.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::traces {

/// The scenario's file without folder and ending.
std::string golden_name(const std::string& scenario);
std::string manifest_path(const std::string& folder, const std::string& name);
std::string trace_path(const std::string& folder, const std::string& name);

/// Names of all goldens there, in order; throws InputError when there is no such folder.
std::vector<std::string> golden_names(const std::string& folder);

struct Golden {  // NOLINT(bugprone-exception-escape): moving throws nothing
  Json manifest;
  std::unique_ptr<Trace> trace;
};

/// The manifest alone; throws InputError.
Json read_manifest(const std::string& folder, const std::string& name);
/// Both files, which must fit each other; throws InputError.
Golden read_golden(const std::string& folder, const std::string& name);
/// The golden of a scenario, which must be the one that it was made from; throws InputError.
Golden read_golden(const std::string& folder, const scenario::Scenario& scenario);

/// The content of both files of a scenario's golden after a run.
struct NewGolden {
  std::string trace;  ///< decompressed
  Json manifest;
};
/// `tool` names the program, `rulings` is of rulings_of.
NewGolden make_golden(const scenario::Scenario& scenario, std::string trace, const std::string& tool,
                      const Json& rulings);
/// Writes those of the two files that differ; returns which were written. Throws InputError when one cannot be written
/// (a full disk); then both stay unchanged, because one without the other is not a golden.
struct Written {
  bool trace = false, manifest = false;
};
Written write_golden(const std::string& folder, const std::string& name, const NewGolden& golden);

}  // namespace dsdpv1::tb::traces

#pragma once
// The manifest of a golden: its inputs and its content.
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "lab/traces/trace.hpp"
#include "tb/scenario/scenario.hpp"

namespace dsdpv1::tb::traces {

using Json = nlohmann::ordered_json;

/// SHA-256 in hexadecimal.
std::string sha256(std::string_view content);

/// The inputs of a run: the scenario's file, the files that it names, the parameters of the chips, which have defaults.
/// Firmware is named without a hash: it is built, and holds the paths of the machine. Throws InputError when a file
/// cannot be read.
Json origin_of(const scenario::Scenario& scenario);

/// True when a scenario names firmware.
bool names_firmware(const scenario::Scenario& scenario);

/// The texts of the rulings with their hashes; `paths` relative to `root`.
Json rulings_of(const std::string& root, const std::vector<std::string>& paths);

/// Counts and hash of a trace.
Json contents_of(const Trace& trace);

/// The first entry of `present`, a group of entries, that differs in `manifest`, in words; empty: none does.
std::string first_other(const Json& manifest, const Json& present);

/// The file's form.
std::string text_of(const Json& manifest);

}  // namespace dsdpv1::tb::traces

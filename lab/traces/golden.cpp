#include "lab/traces/golden.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"
#include "io/output/output_file.hpp"
#include "lab/traces/xz.hpp"

namespace dsdpv1::tb::traces {
namespace {

namespace fs = std::filesystem;

constexpr int kFormat = 1;
constexpr FileKind kManifest{"the manifest of a golden trace", 4};
constexpr FileKind kTrace{"a golden trace (.xz)", 64};
constexpr const char* kManifestEnding = ".json";

std::string regenerate(const std::string& name) { return "./run traces regenerate " + name; }

[[noreturn]] void refuse(const std::string& file, const std::string& why, const std::string& name) {
  throw InputError(file, 0, fmt::format("{}, expected what {} writes", why, regenerate(name)));
}

std::string decompressed(const std::string& path, const std::string& name) {
  Decompressed result = decompress(read_file(path, kTrace), kMostBytes);
  if (!result.wrong.empty()) refuse(path, result.wrong, name);
  return std::move(result.content);
}

/// The content of the trace's file, none when it cannot be read.
std::optional<std::string> present_trace(const std::string& path) {
  const ReadFile file = try_read_file(path, kTrace.most_mb);
  if (!file.wrong.empty()) return std::nullopt;
  Decompressed result = decompress(file.text, kMostBytes);
  return result.wrong.empty() ? std::optional(std::move(result.content)) : std::nullopt;
}

/// All of it is on the disk, under a temporary name until it is committed.
void fill(OutputFile& file, std::string_view content) {
  file.write(content);
  file.flush();
  file.check();
}

}  // namespace

std::string golden_name(const std::string& scenario) { return fs::path(scenario).stem().string(); }

std::string manifest_path(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / (name + kManifestEnding)).string();
}

std::string trace_path(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / (name + ".trace.xz")).string();
}

std::vector<std::string> golden_names(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == kManifestEnding) names.push_back(entry.path().stem().string());
  if (error) throw InputError(folder, 0, "is no folder of golden traces, expected one like traces");
  std::sort(names.begin(), names.end());
  return names;
}

Json read_manifest(const std::string& folder, const std::string& name) {
  const std::string path = manifest_path(folder, name);
  if (!fs::exists(path)) refuse(path, fmt::format("no such file, {} has no golden", name), name);
  Json manifest = Json::parse(read_file(path, kManifest), nullptr, false);
  if (manifest.is_discarded() || !manifest.is_object()) refuse(path, "is no manifest of a golden trace", name);
  if (const std::string other = first_other(manifest, {{"format", kFormat}}); !other.empty())
    refuse(path, "is of another format, " + other, name);
  return manifest;
}

Golden read_golden(const std::string& folder, const std::string& name) {
  const std::string path = trace_path(folder, name);
  Golden golden{read_manifest(folder, name), nullptr};
  golden.trace = std::make_unique<Trace>(decompressed(path, name), path);
  if (const std::string other = first_other(golden.manifest, contents_of(*golden.trace)); !other.empty())
    refuse(path, fmt::format("is not the trace of {}, {}", manifest_path(folder, name), other), name);
  return golden;
}

Golden read_golden(const std::string& folder, const scenario::Scenario& scenario) {
  const std::string name = golden_name(scenario.file), manifest = manifest_path(folder, name);
  if (const std::string other = first_other(read_manifest(folder, name), origin_of(scenario)); !other.empty())
    refuse(scenario.file, fmt::format("is not what {} was made from, {}", manifest, other), name);
  Golden golden = read_golden(folder, name);
  if (golden.trace->signals() != signals_of(scenario))
    refuse(trace_path(folder, name), "has other signals than " + scenario.file, name);
  return golden;
}

NewGolden make_golden(const scenario::Scenario& scenario, std::string trace, const std::string& tool,
                      const Json& rulings) {
  Json manifest = {{"format", kFormat}};
  manifest.update(origin_of(scenario));
  manifest["rulings"] = rulings;
  manifest["tool"] = tool;
  manifest.update(contents_of(Trace(trace, "the trace of " + scenario.file)));
  return {std::move(trace), std::move(manifest)};
}

Written write_golden(const std::string& folder, const std::string& name, const NewGolden& golden) {
  const std::string manifest = text_of(golden.manifest);
  Written written;
  written.trace = present_trace(trace_path(folder, name)) != golden.trace;
  written.manifest = try_read_file(manifest_path(folder, name), kManifest.most_mb).text != manifest;
  std::optional<OutputFile> trace_file, manifest_file;
  if (written.trace) fill(trace_file.emplace(trace_path(folder, name)), compress(golden.trace));
  if (written.manifest) fill(manifest_file.emplace(manifest_path(folder, name)), manifest);
  if (trace_file) trace_file->commit();
  if (manifest_file) manifest_file->commit();
  return written;
}

}  // namespace dsdpv1::tb::traces

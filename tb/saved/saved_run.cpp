#include "tb/saved/saved_run.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "io/input/hash.hpp"
#include "io/input/input_error.hpp"

namespace dsdpv1::tb {
namespace {

using nlohmann::json;
using user_cpu::DebuggerInput;

constexpr std::string_view kMagic = "DSDPV1 saved run ";

std::string fingerprint(std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  return fmt::format("{:016x}", hash.value());
}

json binary(std::string_view bytes) { return json::binary({bytes.begin(), bytes.end()}); }

std::string text_of(const json& binary) {
  const auto& bytes = binary.get_binary();
  return {bytes.begin(), bytes.end()};
}

json json_of(const DebuggerInput& input) {
  return {input.board, input.instructions,       input.at, static_cast<int>(input.kind),
          input.where, json::binary(input.bytes)};
}

DebuggerInput input_of(const json& given) {
  DebuggerInput input;
  input.board = given.at(0);
  input.instructions = given.at(1);
  input.at = given.at(2);
  input.kind = static_cast<DebuggerInput::Kind>(given.at(3).get<int>());
  input.where = given.at(4);
  input.bytes = given.at(5).get_binary();
  return input;
}

json json_of(const SavedRun& run) {
  json files = json::array(), inputs = json::array(), settings = json::array();
  for (const SavedFile& file : run.files) files.push_back({binary(file.path), binary(file.content)});
  for (const DebuggerInput& input : run.inputs) inputs.push_back(json_of(input));
  for (const std::string& setting : run.settings) settings.push_back(binary(setting));
  return {{"program", run.program}, {"scenario", binary(run.scenario)},
          {"settings", settings},   {"engine", run.engine},
          {"view", run.view},       {"checks", run.checks},
          {"fault", run.fault},     {"seed", run.seed ? json(*run.seed) : json()},
          {"files", files},         {"inputs", inputs},
          {"at", run.at},           {"digest", run.digest}};
}

SavedRun run_of(const json& given) {
  SavedRun run;
  run.program = given.at("program");
  run.scenario = text_of(given.at("scenario"));
  for (const json& setting : given.at("settings")) run.settings.push_back(text_of(setting));
  run.engine = given.at("engine");
  run.view = given.at("view");
  run.checks = given.at("checks");
  run.fault = given.at("fault");
  if (!given.at("seed").is_null()) run.seed = given.at("seed").get<std::uint32_t>();
  for (const json& file : given.at("files")) run.files.push_back({text_of(file.at(0)), text_of(file.at(1))});
  for (const json& input : given.at("inputs")) run.inputs.push_back(input_of(input));
  run.at = given.at("at");
  run.digest = given.at("digest");
  return run;
}

[[noreturn]] void damaged(const std::string& path) {
  throw InputError(path, 0, "is damaged, expected a saved run as it was written");
}

}  // namespace

std::string to_bytes(const SavedRun& run) {
  std::string object;
  json::to_cbor(json_of(run), object);
  return fmt::format("{}{} {}\n", kMagic, SavedRun::kVersion, fingerprint(object)) + object;
}

SavedRun parse_saved_run(std::string_view bytes, const std::string& path) {
  if (bytes.substr(0, kMagic.size()) != kMagic)
    throw InputError(path, 0, "is no saved run, expected what run --save-at writes");
  const std::string_view line = bytes.substr(0, bytes.find('\n'));
  const std::string_view object = bytes.substr(std::min(line.size() + 1, bytes.size()));
  const std::string version = fmt::format("{}{} ", kMagic, SavedRun::kVersion);
  if (line.substr(0, version.size()) != version)
    throw InputError(path, 0,
                     fmt::format("is a saved run of another version of the format, expected {}", SavedRun::kVersion));
  if (line.substr(version.size()) != fingerprint(object)) damaged(path);
  try {
    SavedRun run = run_of(json::from_cbor(object.begin(), object.end()));
    if (run.files.empty()) damaged(path);
    return run;
  } catch (const json::exception&) {
    damaged(path);
  }
}

}  // namespace dsdpv1::tb

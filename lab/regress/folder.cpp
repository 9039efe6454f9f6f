#include "lab/regress/folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <system_error>

#include "io/input/input_error.hpp"
#include "io/output/part_file.hpp"
#include "io/output/shell_word.hpp"
#include "io/output/write_file.hpp"
#include "lab/campaign/fingerprint.hpp"

namespace dsdpv1::tb::regress {
namespace {

namespace fs = std::filesystem;
using campaign::Ended;
using campaign::Json;

constexpr const char* kLog = "run.log";
constexpr const char* kResult = "result.json";
constexpr const char* kStimulus = "lockstep.stimulus";
constexpr const char* kDifference = "difference.vcd";
constexpr const char* kCounts = "coverage.info";

bool is_result(const std::string& name) {
  static const std::set<std::string> names = {"index.html", kCoverageInfo, kCoverageTable,
                                              kNotReached,  kRulingsInfo,  kRulingsTable};
  return names.count(name) != 0;
}

/// Each run has its own key, so results of another regression do not interfere.
std::string difference(const Json& /*before*/, const Json& /*now*/) { return ""; }

/// Turns errors of the file system into an error of one line.
template <typename Action>
auto in_folder(const campaign::Folder& folder, const Action& action) {
  try {
    return action();
  } catch (const fs::filesystem_error& error) {
    throw InputError(error.path1().empty() ? folder.path().string() : error.path1().string(), 0,
                     "cannot be written: " + error.code().message());
  }
}

/// A killed run leaves temporary names: its log gets its final name, a wave can be recovered, empty files are removed.
void tidy_up(const fs::path& place) {
  if (!fs::is_directory(place)) return;
  std::vector<fs::path> parts;
  for (const auto& entry : fs::directory_iterator(place))
    if (entry.path().extension() == PartFile::kEnding) parts.push_back(entry.path());
  for (const fs::path& part : parts)
    if (fs::file_size(part) == 0)
      fs::remove(part);
    else if (part.filename().string().rfind(kLog, 0) == 0)
      fs::rename(part, place / kLog);
}

/// The last lines of a text, at most so many characters.
std::string last_lines(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  const std::size_t end = text.find('\n', text.size() - most);
  return end == std::string::npos || end + 1 == text.size() ? text.substr(text.size() - most) : text.substr(end + 1);
}

/// The last lines of a file, some 2 KB.
std::string end_of(const fs::path& file) {
  constexpr std::streamoff kMost = 2048;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : 0;
  in.seekg(std::max<std::streamoff>(0, size - kMost - 1));
  return last_lines({std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()}, kMost);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

/// The words of a run that plays its stimulus, shortened, instead of what has led to it. One of a scenario has its
/// parameters in it.
std::vector<std::string> words_of_stimulus(const Run& run, const std::string& chip, const std::string& stimulus) {
  Run played = run;
  if (run.engine == "cosim") {
    played.options = {"--chip", chip};
    played.settings.clear();
  }
  played.engine = "replay";
  played.scenario = stimulus;
  played.seed.clear();
  const auto random = std::find(played.options.begin(), played.options.end(), "--jobs");
  played.options.erase(random, played.options.end());  // and --cycles
  return played.words();
}

/// A scenario's RTL differs.
bool differs(const Run& run, const Json& result) {
  return run.engine == "cosim" && result.is_object() &&
         result.value("/lockstep/difference"_json_pointer, Json()).is_object();
}

}  // namespace

const campaign::Kind& kind() {
  static const campaign::Kind kind{"regression", "runs", is_result};
  return kind;
}

const std::vector<std::string>& keep_words() {
  static const std::vector<std::string> words = {"none", "failed", "all"};
  return words;
}

std::optional<Keep> keep_named(const std::string& word) {
  const auto found = std::find(keep_words().begin(), keep_words().end(), word);
  if (found == keep_words().end()) return std::nullopt;
  return static_cast<Keep>(found - keep_words().begin());
}

namespace {

Json rtl_json(const OwnRtl& rtl) {
  if (rtl.folder.empty()) return nullptr;
  return {{"folder", rtl.folder},          {"top", rtl.top},    {"pins", rtl.pins},
          {"tolerance", rtl.tolerance},    {"chip", rtl.chip},  {"build", rtl.build},
          {"built_from", rtl.fingerprint}, {"files", rtl.files}};
}

OwnRtl rtl_of(const Json& json) {
  if (json.is_null()) return {};  // not in folders of earlier versions
  return {json.at("folder"), json.at("top"), json.at("pins"), json.at("build"), json.at("chip")};
}

}  // namespace

Json json_of(const Description& description) {
  Json json = {{"format", kind().format()},
               {"versions", {{"dsdpv1", description.program}}},
               {"checks", description.checks},
               {"wave", description.wave},
               {"keep", keep_words().at(static_cast<std::size_t>(description.keep))},
               {"report", description.report},
               {"left_out", description.plan.left_out},
               {"rtl", rtl_json(description.rtl)},
               {"coverage", description.coverage},
               {"runs", Json::array()}};
  if (!description.rtl.verilator.empty()) json["versions"]["verilator"] = description.rtl.verilator;
  for (const Run& run : description.plan.runs) json["runs"].push_back(json_of(run));
  return campaign::as_kept(json);
}

Description last_description(const std::string& folder) {
  const Json json = campaign::description_of(folder, kind());
  try {
    Description description;
    description.checks = json.at("checks");
    description.wave = json.at("wave");
    description.keep = keep_named(json.at("keep")).value_or(Keep::kFailed);
    description.report = json.value("report", false);  // not in folders of earlier versions
    description.plan.left_out = json.at("left_out");
    description.rtl = rtl_of(json.value("rtl", Json()));
    description.coverage = json.value("coverage", false);
    for (const Json& each : json.at("runs")) description.plan.runs.push_back(run_of(each));
    return description;
  } catch (const nlohmann::json::exception&) {
    throw InputError(folder, 0, "holds no regression, --failed needs the folder of the last one");
  }
}

Folder::Folder(const std::string& path, const Description& description, campaign::Folder::Access access)
    : description_(description), folder_(path, kind(), json_of(description), difference, access) {}

/// With the id of this process: a surviving run of an earlier owner writes into a separate place.
std::string Folder::place(const Run& run) const {
  return folder_.item_file(fmt::format("{}.{}.run", run.file_name(), getpid()));
}

std::vector<std::string> Description::words(const Run& run) const {
  std::vector<std::string> words = run.words();
  if (!run.has_own_rtl()) return words;
  const std::vector<std::string> own = rtl.words();
  words.insert(words.end(), own.begin(), own.end());
  return words;
}

std::vector<std::string> Folder::words(const Run& run) const {
  const fs::path files = place(run);
  in_folder(folder_, [&files] { return fs::create_directories(files); });
  std::vector<std::string> words = description_.words(run);
  if (description_.coverage && run.has_own_rtl()) words.insert(words.end(), {"--coverage", files / kCounts});
  if (run.engine == "golden") {
    words.emplace_back("--no-progress");
    return words;
  }
  words.insert(words.end(), {"--result", files / kResult, "--log", files / kLog});
  if (run.has_own_rtl() || run.engine == "lockstep") words.insert(words.end(), {"--difference", files / kDifference});
  if (run.is_stimulus() || run.engine == "cosim") words.insert(words.end(), {"--stimulus", files / kStimulus});
  if (run.engine == "replay") words.emplace_back("--shrink");
  if (run.is_stimulus()) return words;
  if (!run.has_own_rtl()) words.insert(words.end(), {"--quiet", "--no-progress"});
  if (!description_.checks.empty()) words.insert(words.end(), {"--checks", description_.checks});
  if (!description_.wave.empty()) words.insert(words.end(), {"--wave", files / ("wave." + description_.wave)});
  if (description_.report) words.insert(words.end(), {"--report", files / "report.html"});
  return words;
}

std::optional<Outcome> Folder::finished(const Run& run, const std::string& key) const {
  const Json kept = folder_.kept(run.file_name());
  try {
    if (kept.is_null() || kept.at("run") != campaign::as_kept(json_of(run))) return std::nullopt;
    if (!key.empty() && kept.at("key") != key) return std::nullopt;
    Outcome outcome = outcome_of(kept.at("outcome"));
    if (description_.coverage && run.has_own_rtl() && outcome.ran_through() && !fs::exists(counts(run)))
      return std::nullopt;
    return outcome;
  } catch (const nlohmann::json::exception&) {  // not of this form
    return std::nullopt;
  }
}

Outcome Folder::finish(const Run& run, const std::string& key, const Ended& ended) const {
  const fs::path files = place(run);
  in_folder(folder_, [&files] { tidy_up(files); });
  const Json result = campaign::read_json((files / kResult).string());
  Outcome outcome = outcome_of(ended, result);
  if (!outcome.passed()) outcome.log = end_of(files / kLog);
  in_folder(folder_, [&] {
    if (!outcome.passed()) write_again(run, differs(run, result));
    keep_counts(run);
    keep_files(run, outcome);
  });
  // Less than what is kept of it before, whose begin depends on the length of the folder's name.
  constexpr std::size_t kMostOutput = 3072;
  outcome.output =
      last_lines(replaced(outcome.output, files.string(), folder_.item_file(run.file_name())), kMostOutput);
  const Json kept = folder_.keep(
      run.file_name(), {{"key", key}, {"run", json_of(run)}, {"outcome", json_of(outcome)}, {"seen", seen_of(result)}});
  return outcome_of(kept.at("outcome"));
}

/// A script that plays what differs again, from anywhere; it takes more options.
void Folder::write_again(const Run& run, bool differs) const {
  const std::string kept = folder_.item_file(run.file_name());
  const bool has_stimulus = fs::exists(fs::path(place(run)) / kStimulus);
  std::vector<std::string> words =
      has_stimulus ? words_of_stimulus(run, description_.rtl.chip, kept + "/" + kStimulus) : run.words();
  if (run.has_own_rtl()) {
    const std::vector<std::string> own = description_.rtl.words();
    words.insert(words.end(), own.begin(), own.end());
    if (run.engine != "golden") words.insert(words.end(), {"--difference", kept + "/" + kDifference});
  }
  const char* note =
      differs && !has_stimulus ? "# The chip's inputs alone, played as a stimulus, do not show it.\n" : "";
  std::string text = fmt::format("#!/bin/sh\n{}cd {} && exec {}", note, shell_word(fs::current_path().string()),
                                 shell_word(fs::read_symlink("/proc/self/exe").string()));
  for (const std::string& word : words) text += " " + shell_word(word);
  write_file((fs::path(place(run)) / kAgain).string(), text + " \"$@\"\n");
}

Json Folder::seen(const Run& run) const {
  const Json kept = folder_.kept(run.file_name());
  return kept.is_object() ? kept.value("seen", Json()) : Json();
}

void Folder::keep_counts(const Run& run) const {
  const fs::path counted = fs::path(place(run)) / kCounts;
  if (fs::exists(counted))
    fs::rename(counted, counts(run));
  else
    fs::remove(counts(run));
}

void Folder::keep_files(const Run& run, Outcome& outcome) const {
  const fs::path files = place(run), kept = folder_.item_file(run.file_name());
  fs::remove_all(kept);
  const bool wanted = description_.keep == Keep::kAll || (description_.keep == Keep::kFailed && !outcome.passed());
  if (!wanted || !fs::is_directory(files) || fs::is_empty(files)) return forget(run);
  if (const fs::path result = files / kResult; fs::exists(result))
    write_file(result.string(), replaced(campaign::content(result.string()), files.string(), kept.string()));
  fs::rename(files, kept);
  for (const auto& entry : fs::directory_iterator(kept)) outcome.files.push_back(entry.path().filename());
  std::sort(outcome.files.begin(), outcome.files.end());
}

void Folder::forget(const Run& run) const {
  std::error_code ignored;  // the next owner of the folder removes it
  fs::remove_all(place(run), ignored);
}

void Folder::remove(const Run& run) const {
  in_folder(
      folder_,
      [&] {
        fs::remove_all(folder_.item_file(run.file_name()));
        fs::remove(folder_.item_file(run.file_name() + ".json"));
        fs::remove(counts(run));
      });
}

}  // namespace dsdpv1::tb::regress

#include "lab/campaign/folder.hpp"

#include <algorithm>
#include <utility>

#include "io/input/input_error.hpp"
#include "io/output/part_file.hpp"
#include "io/output/write_file.hpp"
#include "lab/campaign/fingerprint.hpp"
#include "lab/campaign/slurm.hpp"

namespace dsdpv1::tb::campaign {
namespace {

namespace fs = std::filesystem;

bool begins_with(const std::string& text, const std::string& part) { return text.rfind(part, 0) == 0; }

/// "00042.4711.run", "00042.json.4711.part": files of a run that no longer exists, among the items.
bool is_remainder(const std::string& name) {
  const std::string ending = fs::path(name).extension();
  return ending == ".run" || ending == ".err" || ending == PartFile::kEnding;
}

[[noreturn]] void fail(const fs::path& path, const Kind& kind, const fs::filesystem_error& error) {
  throw InputError(path.string(), 0, "cannot be used for a " + kind.word + ": " + error.code().message());
}

void add_all_in(const fs::path& folder, std::vector<fs::path>& files) {
  if (!fs::is_directory(folder)) return;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) files.push_back(entry.path());
}

/// A temporary file of a killed process: of the description, or of a result.
bool is_part_of(std::string name, const Kind& kind) {
  if (begins_with(name, ".")) name.erase(0, 1);
  const std::size_t end = name.find(PartFile::kEnding);
  if (end == std::string::npos) return false;
  name.resize(end);
  const auto own = [&kind](const std::string& each) { return each == kind.description() || kind.is_result(each); };
  return own(name) || own(name.substr(0, name.rfind('.')));  // with a process id, or without
}

}  // namespace

std::vector<fs::path> own_files(const fs::path& folder, const Kind& kind) {
  std::vector<fs::path> files;
  try {
    if (!fs::is_directory(folder)) return files;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename();
      if (name == kind.description() || kind.is_result(name) || is_part_of(name, kind)) files.push_back(entry.path());
    }
    for (const std::string& part : {kind.items, std::string(kSlurmFolder)}) add_all_in(folder / part, files);
  } catch (const fs::filesystem_error& error) {
    fail(folder, kind, error);
  }
  return files;
}

Json description_of(const fs::path& folder, const Kind& kind) {
  const Json json = read_json((folder / kind.description()).string());
  return json.is_object() && json.value("format", Json()) == kind.format() ? json : Json();
}

Folder::Folder(fs::path path, Kind kind, const Json& description, Difference difference, Access access)
    : path_(std::move(path)), kind_(std::move(kind)), difference_(std::move(difference)) {
  try {
    if (access == Access::kTask)
      join(description);
    else
      own(description);
  } catch (const fs::filesystem_error& error) {
    fail(path_, kind_, error);
  }
}

void Folder::own(const Json& description) {
  if (fs::exists(path_) && !fs::is_directory(path_))
    throw InputError(path_.string(), 0, "is a file, expected a folder for the " + kind_.word);
  lock_.emplace(path_, kind_.word);
  Json before = fs::exists(file(kind_.description())) ? read_json(file(kind_.description())) : Json();
  const bool ours = before.is_object() && before.value("format", Json()) == kind_.format();
  const bool damaged = before.is_discarded();
  if (damaged) before = Json();  // a discarded value would compare equal to anything
  if (!ours && holds_something_else(damaged))
    throw InputError(path_.string(), 0,
                     "holds something else, expected a new or empty folder, or one of a " + kind_.word);
  if (ours) started_anew_ = difference_(before, description);
  if (damaged) started_anew_ = "nothing that can be known, its " + kind_.description() + " is damaged";
  if (!started_anew_.empty()) clear();
  if (!fs::exists(path_ / kSlurmFolder)) tidy();  // else tasks in a cluster may still be writing
  // First, so that a folder with items always has a description.
  if (before != description) write_file(file(kind_.description()), description.dump(2) + "\n");
  fs::create_directories(path_ / kind_.items);
}

/// The owner may have begun another campaign since it submitted the task.
void Folder::join(const Json& description) const {
  if (description_of(path_, kind_) != description)
    throw InputError(path_.string(), 0, "is not about this " + kind_.word + " any more, its task has nothing to do");
}

/// A campaign's files count only if a description, even a damaged one, exists.
bool Folder::holds_something_else(bool known) const {
  const auto is_else = [this, known](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename();
    if (name == Lock::name(kind_.word) || is_left_over(name)) return false;
    return !known || !(name == kind_.items || name == kSlurmFolder || is_result(name));
  };
  return std::any_of(fs::directory_iterator(path_), fs::directory_iterator(), is_else);
}

/// Only files that a campaign writes.
void Folder::clear() const {
  fs::remove_all(path_ / kind_.items);
  for (const auto& entry : fs::directory_iterator(path_))
    if (kind_.is_result(entry.path().filename())) fs::remove(entry.path());
}

void Folder::tidy() const {
  for (const auto& entry : fs::directory_iterator(path_))
    if (is_left_over(entry.path().filename())) fs::remove(entry.path());
  if (!fs::exists(path_ / kind_.items)) return;
  for (const auto& entry : fs::directory_iterator(path_ / kind_.items))
    if (is_remainder(entry.path().filename())) fs::remove_all(entry.path());
}

bool Folder::is_result(const std::string& name) const { return name == kind_.description() || kind_.is_result(name); }

bool Folder::is_left_over(std::string name) const { return is_part_of(std::move(name), kind_); }

Json Folder::kept(const std::string& name) const {
  Json item = read_json(item_file(name + ".json"));
  if (!item.is_object() || !item.contains("sum")) return nullptr;
  const Json sum = item["sum"];
  item.erase("sum");
  return sum == fingerprint(text_of(item)) ? item : Json();
}

Json Folder::keep(const std::string& name, const Json& item) const {
  Json kept = as_kept(item);
  Json with_sum = kept;
  with_sum["sum"] = fingerprint(text_of(kept));
  write_file(item_file(name + ".json"), text_of(with_sum) + "\n");
  return kept;
}

}  // namespace dsdpv1::tb::campaign

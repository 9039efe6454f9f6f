#pragma once
// Where a campaign keeps what its runs have shown, so that an interrupted one goes on where it stopped.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lab/campaign/lock.hpp"

namespace dsdpv1::tb::campaign {

using Json = nlohmann::ordered_json;

/// A kind of campaign and the names that it uses.
struct Kind {
  std::string word;                            ///< "sweep": sweep.json says what the folder is about
  std::string items;                           ///< "points": the folder of what is finished
  bool (*is_result)(const std::string& name);  ///< a file that it leaves beside them at the end
  std::string description() const { return word + ".json"; }
  std::string format() const { return "dsdpv1-sim " + word + " 1"; }
};

/// The files in a folder that a campaign there writes or removes, as far as they exist. Throws InputError when it
/// cannot be read.
std::vector<std::filesystem::path> own_files(const std::filesystem::path& folder, const Kind& kind);

/// What the folder is about; null when it says nothing.
Json description_of(const std::filesystem::path& folder, const Kind& kind);

/// WORD.json says what the folder is about, ITEMS/NAME.json is a finished item. It belongs to one process at a time,
/// and to the tasks that this one has submitted to a cluster.
class Folder {
 public:
  enum class Access : std::uint8_t { kOwner, kTask };
  /// In what the second is another campaign, of which nothing that the first has kept is of use: "other parameters".
  using Difference = std::string (*)(const Json& before, const Json& now);

  /// Opens or makes the folder; `description` has the member format. What another campaign has kept there is removed. A
  /// task finds the folder made. Throws InputError for a folder that holds something else, that another process has, or
  /// that cannot be written, and to a task when the folder is about something else by now.
  Folder(std::filesystem::path path, Kind kind, const Json& description, Difference difference, Access access);

  /// In what an earlier campaign in this folder was another one; empty when nothing was removed.
  const std::string& started_anew() const { return started_anew_; }
  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string item_file(const std::string& name) const { return (path_ / kind_.items / name).string(); }

  /// What was kept under this name, null when that is nothing, or damaged.
  Json kept(const std::string& name) const;
  /// Keeps it, as a whole or not at all; returns it as it is kept. Throws InputError when it cannot be written.
  Json keep(const std::string& name, const Json& item) const;
  /// Removes what campaigns that were killed have left half done.
  void tidy() const;

 private:
  void own(const Json& description);
  void join(const Json& description) const;
  bool holds_something_else(bool known) const;
  void clear() const;
  bool is_result(const std::string& name) const;
  bool is_left_over(std::string name) const;

  std::filesystem::path path_;
  Kind kind_;
  Difference difference_;
  std::optional<Lock> lock_;
  std::string started_anew_;
};

}  // namespace dsdpv1::tb::campaign

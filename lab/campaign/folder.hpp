#pragma once
// The folder with the results of a campaign's runs, so that an interrupted one can continue.
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
  std::string word;                            ///< "sweep": sweep.json describes the folder
  std::string items;                           ///< "points": the folder of finished items
  bool (*is_result)(const std::string& name);  ///< a file that it writes beside them at the end
  std::string description() const { return word + ".json"; }
  std::string format() const { return "dsdpv1-sim " + word + " 1"; }
};

/// The files in a folder that a campaign there writes or removes, if they exist. Throws InputError when it cannot be
/// read.
std::vector<std::filesystem::path> own_files(const std::filesystem::path& folder, const Kind& kind);

/// The folder's description; null when there is none.
Json description_of(const std::filesystem::path& folder, const Kind& kind);

/// WORD.json describes the folder, ITEMS/NAME.json is a finished item. It belongs to one process at a time,
/// and to the tasks that this one has submitted to a cluster.
class Folder {
 public:
  enum class Access : std::uint8_t { kOwner, kTask };
  /// The difference that makes the second another campaign, so that the first one's items are useless: "other
  /// parameters".
  using Difference = std::string (*)(const Json& before, const Json& now);

  /// Opens or makes the folder; `description` has the member format. Items of another campaign are removed. For a task
  /// the folder must exist. Throws InputError for a folder that holds something else, that another process has, or that
  /// cannot be written, and to a task when the folder belongs to another campaign by now.
  Folder(std::filesystem::path path, Kind kind, const Json& description, Difference difference, Access access);

  /// The difference to an earlier campaign in this folder; empty when nothing was removed.
  const std::string& started_anew() const { return started_anew_; }
  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string item_file(const std::string& name) const { return (path_ / kind_.items / name).string(); }

  /// The item with this name, null when it is missing or damaged.
  Json kept(const std::string& name) const;
  /// Stores it, completely or not at all; returns the stored form. Throws InputError when it cannot be written.
  Json keep(const std::string& name, const Json& item) const;
  /// Removes unfinished files of killed campaigns.
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

#pragma once
// Where a sweep keeps its points, so that an interrupted one goes on where it stopped.
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tb/sweep/inputs.hpp"
#include "tb/sweep/lock.hpp"
#include "tb/sweep/plan.hpp"
#include "tb/sweep/point.hpp"

namespace tb::sweep {

/// What the points of a plan depend on: program, scenario and the files that it names (by content), settings,
/// parameters.
nlohmann::ordered_json identity(const Plan& plan, const Inputs& inputs, const std::string& program);

/// "0.1.0 1f0c...": the version and what the program is made of, so that a program built anew counts as another one.
std::string program_identity(const std::string& version);

/// The files in a folder that a sweep there writes or removes, as far as they exist. Throws InputError when it cannot
/// be read.
std::vector<std::filesystem::path> own_files(const std::filesystem::path& folder);

/// sweep.json says what the folder is about, points/00042.json is a finished point: settings, exit code, result. It
/// belongs to one process at a time.
class Folder {
 public:
  /// Opens or makes the folder. Points of another identity are removed. Throws InputError for a folder that holds
  /// something else, that another process has, or that cannot be written.
  Folder(std::filesystem::path path, const nlohmann::ordered_json& identity);

  /// In what an earlier sweep in this folder was another one ("other parameters"); empty when none was removed.
  const std::string& started_anew() const { return started_anew_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  /// Name for a run that is under way, to be removed by `finish` or `forget`.
  std::string result_file(std::size_t point) const;

  /// The point as it was finished before; nullopt when it was not, or its file is damaged or about something else.
  std::optional<Point> finished(std::size_t point, const Plan& plan) const;
  /// Keeps what the run of a point has left behind; `error` is why the scenario is refused at this point (exit code 2).
  /// Keeps nothing and returns nullopt when that says nothing about the point. Throws InputError when it cannot be
  /// written.
  std::optional<Point> finish(std::size_t point, const Plan& plan, int exit, const std::string& error) const;
  void forget(std::size_t point) const;

 private:
  std::string point_file(std::size_t point, const std::string& ending) const;
  void open(const nlohmann::ordered_json& identity);
  bool holds_something_else(bool swept) const;
  void clear() const;
  void tidy() const;

  std::filesystem::path path_;
  std::string identity_;  ///< its fingerprint, in each point
  std::optional<Lock> lock_;
  std::string started_anew_;
};

}  // namespace tb::sweep

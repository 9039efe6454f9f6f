#pragma once
// Where a sweep keeps its points, so that an interrupted one goes on where it stopped.
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tb/sweep/plan.hpp"
#include "tb/sweep/point.hpp"

namespace tb::sweep {

/// What the points of a plan depend on: program, scenario and the files that it names (by content), settings, parameters. Throws
/// InputError for a scenario that cannot be read.
nlohmann::ordered_json identity(const Plan& plan, const std::string& program);

/// "0.1.0 1f0c...": the version and what the program is made of, so that a program built anew counts as another one.
std::string program_identity(const std::string& version);

/// sweep.json says what the folder is about, points/00042.json is a finished point: settings, exit code, result.
class Folder {
 public:
  /// Opens or makes the folder. Points of another identity are removed. Throws InputError for a folder that holds something else
  /// or cannot be written.
  Folder(std::filesystem::path path, const nlohmann::ordered_json& identity);

  /// In what an earlier sweep in this folder was another one ("other parameters"); empty when none was removed.
  const std::string& started_anew() const { return started_anew_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  /// Names for a run that is under way, to be removed by `finish` or `forget`.
  std::string result_file(std::size_t point) const { return point_file(point, ".run"); }
  std::string error_file(std::size_t point) const { return point_file(point, ".err"); }

  /// The point as it was finished before; nullopt when it was not, or its run was killed.
  std::optional<Point> finished(std::size_t point) const;
  /// Keeps what the run of a point has left behind.
  Point finish(std::size_t point, const Plan& plan, int exit) const;
  void forget(std::size_t point) const;

 private:
  std::string point_file(std::size_t point, const char* ending) const;
  void open(const nlohmann::ordered_json& identity);
  void clear() const;

  std::filesystem::path path_;
  std::string started_anew_;
};

}  // namespace tb::sweep

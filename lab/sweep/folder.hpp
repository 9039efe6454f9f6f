#pragma once
// The folder of a sweep: points/00042.json is a finished point: settings, exit code, result.
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "lab/campaign/folder.hpp"
#include "lab/sweep/inputs.hpp"
#include "lab/sweep/plan.hpp"
#include "lab/sweep/point.hpp"

namespace dsdpv1::tb::sweep {

const campaign::Kind& kind();

/// What the points of a plan depend on: program, scenario and the files that it names (by content), settings,
/// parameters.
nlohmann::ordered_json identity(const Plan& plan, const Inputs& inputs, const std::string& program);

class Folder {
 public:
  using Access = campaign::Folder::Access;

  /// Opens or makes the folder. Points of another identity are removed. Throws InputError as campaign::Folder.
  Folder(const std::filesystem::path& path, const nlohmann::ordered_json& identity, Access access = Access::kOwner);

  /// In what an earlier sweep in this folder was another one ("other parameters"); empty when none was removed.
  const std::string& started_anew() const { return folder_.started_anew(); }
  std::string file(const std::string& name) const { return folder_.file(name); }
  const campaign::Folder& base() const { return folder_; }
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
  campaign::Folder folder_;
  std::string identity_;  ///< its fingerprint, in each point
};

}  // namespace dsdpv1::tb::sweep

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

/// The inputs of a plan's points: program, scenario and the files that it names (by content), settings, parameters.
nlohmann::ordered_json identity(const Plan& plan, const Inputs& inputs, const std::string& program);

class Folder {
 public:
  using Access = campaign::Folder::Access;

  /// Opens or makes the folder. Points of another identity are removed. Throws InputError as campaign::Folder.
  Folder(const std::filesystem::path& path, const nlohmann::ordered_json& identity, Access access = Access::kOwner);

  /// The difference to an earlier sweep in this folder ("other parameters"); empty when none was removed.
  const std::string& started_anew() const { return folder_.started_anew(); }
  std::string file(const std::string& name) const { return folder_.file(name); }
  const campaign::Folder& base() const { return folder_; }
  /// File of a run in progress, removed by `finish` or `forget`.
  std::string result_file(std::size_t point) const;

  /// The point if it was finished before; nullopt if not, or if its file is damaged or of another sweep.
  std::optional<Point> finished(std::size_t point, const Plan& plan) const;
  /// Stores the result of a point's run; `error` is the reason of a refusal (exit code 2). Stores nothing and returns
  /// nullopt when the run gives no result for the point. Throws InputError when it cannot be written.
  std::optional<Point> finish(std::size_t point, const Plan& plan, int exit, const std::string& error) const;
  void forget(std::size_t point) const;

 private:
  campaign::Folder folder_;
  std::string identity_;  ///< its fingerprint, in each point
};

}  // namespace dsdpv1::tb::sweep

#pragma once
// Shared options of sweep and regress: many runs, here or in a cluster, and their folder.
#include <CLI/CLI.hpp>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "apps/options/outputs.hpp"
#include "lab/campaign/folder.hpp"
#include "lab/campaign/jobs.hpp"

namespace dsdpv1::app {

struct CampaignArguments {
  std::string out;               ///< folder; empty: the command's own
  unsigned jobs = 0;             ///< processes; 0: as many as there are processors
  std::optional<bool> progress;  ///< absent: on a terminal
  bool quiet = false;
  bool slurm = false;              ///< as tasks of a Slurm cluster
  std::string slurm_options;       ///< more words for sbatch
  int slurm_task = 0;              ///< above 0: this process is such a task, of this submission in the folder
  std::vector<std::string> words;  ///< the command line without the program's name

  bool is_task() const { return slurm_task != 0; }
  tb::campaign::Folder::Access access() const {
    return is_task() ? tb::campaign::Folder::Access::kTask : tb::campaign::Folder::Access::kOwner;
  }
};

/// `usual_folder`: in words, where `out` is left out.
void add_campaign_options(CLI::App& app, CampaignArguments& arguments, const std::string& usual_folder);

/// Files written or removed in the folder; existing ones may be an input or a link to one.
std::vector<NamedFile> outputs_in(const std::string& folder, const tb::campaign::Kind& kind);

/// Runs the jobs that are not finished; of a task, its own. Says how many were finished before. False when it was
/// interrupted, which it says too. `identity`: what the jobs depend on. A run that takes longer than `limit` is killed.
bool carry_out_jobs(const CampaignArguments& arguments, const tb::campaign::Kind& kind, tb::campaign::Jobs& jobs,
                    const tb::campaign::Folder& folder, const std::string& identity,
                    std::optional<std::chrono::duration<double>> limit = std::nullopt);

}  // namespace dsdpv1::app

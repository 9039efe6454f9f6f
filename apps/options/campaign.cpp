#include "apps/options/campaign.hpp"

#include <fmt/format.h>
#include <filesystem>
#include <iostream>

#include "apps/interrupt.hpp"
#include "apps/options/common.hpp"
#include "lab/campaign/runner.hpp"
#include "lab/campaign/slurm_runner.hpp"

namespace dsdpv1::app {
namespace {

using tb::campaign::Carrying;
using tb::campaign::Kind;

Carrying carrying_of(const CampaignArguments& arguments, const Kind& kind,
                     std::optional<std::chrono::duration<double>> limit) {
  return {kind, at_a_time(arguments.jobs), limit, shows_progress(arguments.progress), interrupted};
}

void say_interrupted(const Kind& kind, std::size_t done, std::size_t all) {
  std::cerr << fmt::format("{}: interrupted, {} of {} {} are kept; the same command resumes from there\n", kind.word,
                           done, all, kind.items);
}

/// A task looks at its own jobs only: of many tasks each would read what all have kept.
bool run_task(const CampaignArguments& arguments, Carrying carrying, tb::campaign::Jobs& jobs,
              const tb::campaign::Folder& folder) {
  carrying.at_a_time = 1;  // the cluster has counted a task as one
  carrying.progress = false;
  const std::vector<std::size_t> own = tb::campaign::jobs_of_task(folder.path(), arguments.slurm_task, jobs.size());
  for (const std::size_t job : own) jobs.look(job);
  return tb::campaign::Runner(jobs, carrying, own).run();
}

template <typename Runner>
bool run_all(Runner&& runner, const Kind& kind, std::size_t all) {
  const bool complete = runner.run();
  if (!complete) say_interrupted(kind, runner.done(), all);
  return complete;
}

}  // namespace

void add_campaign_options(CLI::App& app, CampaignArguments& arguments, const std::string& usual_folder) {
  app.add_option("--out", arguments.out, "Folder for the runs and results; default: " + usual_folder);
  app.add_option("--jobs", arguments.jobs, "Parallel processes (default: one per processor)")
      ->check(CLI::Range(1, 256));
  CLI::Option* slurm = app.add_flag("--slurm", arguments.slurm,
                                    "Run as a job array of a Slurm cluster (sbatch), whose nodes must see the folder");
  app.add_option("--slurm-options", arguments.slurm_options, "More options for sbatch: \"--partition=x --time=10\"")
      ->needs(slurm);
  app.add_option("--slurm-task", arguments.slurm_task)->group("");  // what the tasks of an array call
  add_output_options(app, arguments.progress, arguments.quiet);
}

std::vector<NamedFile> outputs_in(const std::string& folder, const Kind& kind) {
  std::vector<NamedFile> outputs;
  for (const std::filesystem::path& file : tb::campaign::own_files(folder, kind))
    outputs.push_back({file.lexically_relative(folder).string() + " of --out", file.string()});
  return outputs;
}

bool carry_out_jobs(const CampaignArguments& arguments, const Kind& kind, tb::campaign::Jobs& jobs,
                    const tb::campaign::Folder& folder, const std::string& identity,
                    std::optional<std::chrono::duration<double>> limit) {
  const Carrying carrying = carrying_of(arguments, kind, limit);
  if (arguments.is_task()) return run_task(arguments, carrying, jobs, folder);
  for (const std::size_t job : all_of(jobs)) jobs.look(job);
  if (const std::size_t kept = count_finished(jobs); kept != 0)
    std::cerr << fmt::format("{}: {} of {} {} are there already\n", kind.word, kept, jobs.size(), kind.items);
  if (!arguments.slurm) return run_all(tb::campaign::Runner(jobs, carrying), kind, jobs.size());
  return run_all(
      tb::campaign::SlurmRunner(jobs, folder, carrying, {identity, arguments.slurm_options, arguments.words}), kind,
      jobs.size());
}

}  // namespace dsdpv1::app

#pragma once
// A Slurm cluster, by its commands sbatch, squeue and scancel. sacct is not needed.
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dsdpv1::tb::campaign {

constexpr const char* kSlurmFolder = "slurm";  ///< in the folder of a campaign, while tasks exist

using Tasks = std::vector<std::vector<std::size_t>>;  ///< the jobs of each task of an array

/// A job array. slurm/1.json lists the jobs of its tasks, slurm/1.sh is a task's script, slurm/1_7.out the output of
/// task 7.
struct Submission {
  int number = 0;        ///< in the folder
  std::string identity;  ///< of the campaign
  std::string job;       ///< Slurm's number; empty: unknown
  Tasks tasks;
};

class Slurm {
 public:
  /// `folder`: of the campaign, seen by all nodes under the same name; `options`: more words for sbatch.
  Slurm(const std::filesystem::path& folder, std::string options);

  /// The arrays whose files are in the folder; damaged files are ignored.
  std::vector<Submission> submissions() const;
  /// Submits tasks, each of which calls `command` with --slurm-task. Throws InputError with Slurm's line when it is
  /// refused.
  Submission submit(const std::string& identity, const Tasks& tasks, const std::vector<std::string>& command) const;
  /// The tasks that wait or run, by Slurm's number; nullopt when Slurm does not answer now.
  static std::optional<std::map<std::string, std::set<std::size_t>>> under_way();
  /// Cancels its tasks; they may have ended.
  static void cancel(const Submission& submission);
  /// The last line of a task's output.
  std::string last_line(const Submission& submission, std::size_t task) const;
  void forget(const Submission& submission) const;

 private:
  std::string file(int submission, const std::string& ending) const;
  void write(const Submission& submission) const;

  std::filesystem::path folder_;
  std::string options_;
};

/// The jobs of this process as a task of an array: `number` of --slurm-task, and SLURM_ARRAY_TASK_ID. Throws InputError
/// when it is not a task, or has a job that is not below `jobs`.
std::vector<std::size_t> jobs_of_task(const std::filesystem::path& folder, int number, std::size_t jobs);

/// Largest number of tasks of an array (Slurm's usual limit is 1001): with more jobs a task has several.
Tasks in_tasks(const std::vector<std::size_t>& jobs, std::size_t most = 1000);

}  // namespace dsdpv1::tb::campaign

#include "lab/campaign/slurm_runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <thread>
#include <utility>

#include "io/input/input_error.hpp"

namespace dsdpv1::tb::campaign {
namespace {

constexpr std::chrono::milliseconds kPause(50);
constexpr std::chrono::milliseconds kBetweenLooks(500), kBetweenQuestions(2000);
constexpr int kMostTries = 2;

}  // namespace

SlurmRunner::SlurmRunner(Jobs& jobs, const Folder& folder, Carrying carrying, OnCluster cluster)
    : jobs_(jobs),
      folder_(folder),
      carrying_(std::move(carrying)),
      cluster_(std::move(cluster)),
      slurm_(folder.path(), cluster_.options),
      bar_(jobs.size(), carrying_.kind.items, carrying_.progress),
      done_(count_finished(jobs)) {
  for (const std::size_t job : all_of(jobs))
    if (!jobs.finished(job)) missing_.insert(job);
  bar_.begin(done_);
}

bool SlurmRunner::run() {
  take_over();
  try {
    wait_for_all();
  } catch (...) {
    bar_.clear();  // the error line has its own line
    throw;
  }
  bar_.clear();
  end_all();
  return missing_.empty();
}

/// Cancels tasks of an earlier campaign in the folder, which are useless now.
void SlurmRunner::take_over() {
  for (const Submission& each : slurm_.submissions()) {
    if (each.identity == cluster_.identity) {
      submissions_.push_back(each);
    } else {
      Slurm::cancel(each);
      slurm_.forget(each);
    }
  }
}

void SlurmRunner::wait_for_all() {
  Clock::time_point look_at = Clock::now(), ask_at = look_at;
  if (submissions_.empty()) submit_missing();
  while (!missing_.empty() && !carrying_.interrupted()) {
    if (Clock::now() >= ask_at) {
      ask();
      ask_at = Clock::now() + kBetweenQuestions;
    }
    if (Clock::now() >= look_at) {
      collect();
      look_at = Clock::now() + kBetweenLooks;
    }
    bar_.show(done_);
    std::this_thread::sleep_for(kPause);
  }
}

void SlurmRunner::collect() {
  for (auto job = missing_.begin(); job != missing_.end();)
    job = jobs_.look(*job) ? missing_.erase(job) : std::next(job);
  done_ = jobs_.size() - missing_.size();
}

/// A task that Slurm no longer lists has written its results, but another node's files may take a moment to appear
/// here. It is lost when they are missing at the next question, too.
void SlurmRunner::ask() {
  const auto tasks = Slurm::under_way();
  if (!tasks) return;
  under_way_.clear();
  for (const Submission& each : submissions_) {
    const auto found = tasks->find(each.job);
    if (found == tasks->end()) continue;
    for (const std::size_t task : found->second)
      if (task < each.tasks.size()) under_way_.insert(each.tasks[task].begin(), each.tasks[task].end());
  }
  collect();
  submit_missing();
}

void SlurmRunner::submit_missing() {
  std::vector<std::size_t> lost = gone();
  const std::set<std::size_t> before = std::exchange(not_seen_, {lost.begin(), lost.end()});
  if (!submissions_.empty())
    lost.erase(std::remove_if(lost.begin(), lost.end(), [&before](std::size_t job) { return before.count(job) == 0; }),
               lost.end());
  if (lost.empty()) return;
  for (const std::size_t job : lost) check_tries(job);
  submissions_.push_back(slurm_.submit(cluster_.identity, in_tasks(lost), cluster_.command));
  for (const std::size_t job : lost) {
    ++tries_[job];
    not_seen_.erase(job);
  }
}

/// The missing jobs without a task.
std::vector<std::size_t> SlurmRunner::gone() const {
  std::vector<std::size_t> jobs;
  std::set_difference(missing_.begin(), missing_.end(), under_way_.begin(), under_way_.end(), std::back_inserter(jobs));
  return jobs;
}

void SlurmRunner::check_tries(std::size_t job) const {
  const auto tries = tries_.find(job);
  if (tries == tries_.end() || tries->second < kMostTries) return;
  std::string said;
  for (const Submission& each : submissions_)
    for (std::size_t task = 0; task < each.tasks.size(); ++task)
      if (std::count(each.tasks[task].begin(), each.tasks[task].end(), job) != 0) said = slurm_.last_line(each, task);
  throw InputError(fmt::format("dsdpv1-sim {}: {} cannot be run: {}; {} of {} {} are kept", carrying_.kind.word,
                               jobs_.name(job), said.empty() ? "its task was lost twice" : said, done_, jobs_.size(),
                               carrying_.kind.items));
}

void SlurmRunner::end_all() {
  for (const Submission& each : submissions_) {
    Slurm::cancel(each);
    slurm_.forget(each);
  }
  folder_.tidy();
}

}  // namespace dsdpv1::tb::campaign

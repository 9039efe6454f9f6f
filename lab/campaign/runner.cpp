#include "lab/campaign/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "io/input/input_error.hpp"

namespace dsdpv1::tb::campaign {

std::string fate(const Ended& ended) {
  constexpr int kInterrupted = 130;  // the run's exit code for it
  std::string said = ended.last_line();
  if (!said.empty()) return said;
  if (ended.exit > kSignalled && ended.exit != kInterrupted)
    return fmt::format("its run was killed by signal {}", ended.exit - kSignalled);
  return fmt::format("its run ended with exit code {} and no result", ended.exit);
}

std::vector<std::size_t> all_of(const Jobs& jobs) {
  std::vector<std::size_t> all(jobs.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

std::size_t count_finished(const Jobs& jobs) {
  const std::vector<std::size_t> all = all_of(jobs);
  const auto count = std::count_if(all.begin(), all.end(), [&jobs](std::size_t job) { return jobs.finished(job); });
  return static_cast<std::size_t>(count);
}

Runner::Runner(Jobs& jobs, Carrying carrying) : Runner(jobs, std::move(carrying), all_of(jobs)) {}

Runner::Runner(Jobs& jobs, Carrying carrying, const std::vector<std::size_t>& wanted)
    : jobs_(jobs),
      carrying_(std::move(carrying)),
      bar_(wanted.size(), carrying_.kind.items, carrying_.progress),
      tried_(jobs.size(), false),
      all_(wanted.size()) {
  std::copy_if(wanted.begin(), wanted.end(), std::back_inserter(waiting_),
               [&jobs](std::size_t job) { return !jobs.finished(job); });
  // NOLINTNEXTLINE(cppcoreguidelines-prefer-member-initializer): the waiting jobs are known only now
  done_ = all_ - waiting_.size();
  bar_.begin(done_);
}

bool Runner::run() {
  try {
    run_missing();
  } catch (...) {
    bar_.clear();  // the error line has its own line
    throw;
  }
  give_up();
  bar_.clear();
  return done_ == all_;
}

void Runner::run_missing() {
  while (done_ < all_ && !carrying_.interrupted()) {
    while (children_.running() < carrying_.at_a_time && start_next()) {
    }
    if (const std::optional<Ended> ended = children_.wait()) take(*ended);
    bar_.show(done_);
  }
}

bool Runner::start_next() {
  if (waiting_.empty()) return false;
  const std::size_t job = waiting_.front();
  waiting_.pop_front();
  children_.start(job, jobs_.begin(job), carrying_.limit);
  return true;
}

void Runner::take(const Ended& ended) {
  const std::string why = jobs_.end(ended);
  if (jobs_.finished(ended.job)) {
    ++done_;
    return;
  }
  jobs_.forget(ended.job);
  if (!carrying_.interrupted()) try_again(ended, why);
}

void Runner::try_again(const Ended& ended, const std::string& why) {
  if (tried_[ended.job])
    throw InputError(fmt::format("dsdpv1-sim {}: {} cannot be run: {}; {} of {} {} are kept", carrying_.kind.word,
                                 jobs_.name(ended.job), why, done_, all_, carrying_.kind.items));
  tried_[ended.job] = true;
  waiting_.push_front(ended.job);
}

void Runner::give_up() {
  children_.terminate();
  while (children_.running() != 0)
    if (const std::optional<Ended> ended = children_.wait()) jobs_.forget(ended->job);
}

}  // namespace dsdpv1::tb::campaign

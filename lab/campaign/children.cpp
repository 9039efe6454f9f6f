#include "lab/campaign/children.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <utility>

#include "io/output/signals_held.hpp"
#include "lab/campaign/fingerprint.hpp"

namespace dsdpv1::tb::campaign {
namespace {

constexpr const char* kThisProgram = "/proc/self/exe";  // also when the file was replaced meanwhile
constexpr int kNotStarted = 127;
constexpr std::chrono::milliseconds kMoment(10);
constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};

[[noreturn]] void give_up() {
  dprintf(STDERR_FILENO, "the run cannot be started: %s\n", std::strerror(errno));
  _exit(kNotStarted);
}

/// In the child: dies with its parent (with the thread that called fork, which is the only one), also when that has
/// died already.
void bind_to(pid_t parent) {
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) give_up();
  if (getppid() != parent) _exit(kNotStarted);
}

[[noreturn]] void become(std::vector<char*>& argv, int output, pid_t parent, const SignalsHeld& signals) {
  dup2(output, STDERR_FILENO);
  bind_to(parent);
  const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nothing < 0 || dup2(nothing, STDIN_FILENO) < 0 || dup2(output, STDOUT_FILENO) < 0) give_up();
  for (const int signal : kSignals)  // blocked meanwhile; ignored signals (nohup) stay ignored
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
  signals.release();
  execv(kThisProgram, argv.data());
  give_up();
}

std::string end_of(int file) {
  std::array<char, 4096> text{};
  const off_t size = lseek(file, 0, SEEK_END), most = static_cast<off_t>(text.size());
  const ssize_t count = pread(file, text.data(), text.size(), size > most ? size - most : 0);
  return {text.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
}

}  // namespace

std::string Ended::last_line() const { return campaign::last_line(output); }

Children::~Children() {
  terminate();
  while (running() != 0) wait();
}

void Children::start(std::size_t job, const std::vector<std::string>& arguments, std::optional<Seconds> limit) {
  std::vector<std::string> words = {"dsdpv1-sim"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int output = memfd_create("output", MFD_CLOEXEC);
  if (output >= 0) fcntl(output, F_SETFL, O_APPEND);  // both channels of the run
  const pid_t parent = getpid();
  const SignalsHeld signals;  // a signal for the child must not be lost in the inherited handler
  const pid_t pid = output < 0 ? -1 : fork();
  if (pid == 0) become(argv, output, parent, signals);
  if (pid > 0) {
    runs_[pid] = {job, output, Clock::now(), limit, false};
    return;
  }
  Ended never{job, kNotStarted, std::string("no process can be started: ") + std::strerror(errno), 0, false};
  not_started_.push_back(std::move(never));
  if (output >= 0) close(output);
}

std::optional<Ended> Children::wait() {
  if (!not_started_.empty()) {
    Ended ended = std::move(not_started_.back());
    not_started_.pop_back();
    return ended;
  }
  kill_the_late();
  int status = 0;
  const pid_t pid = waitpid(-1, &status, WNOHANG);
  const auto found = runs_.find(pid);
  if (found == runs_.end()) {
    std::this_thread::sleep_for(kMoment);
    return std::nullopt;
  }
  const Run run = found->second;
  runs_.erase(found);
  return ended(run, status);
}

void Children::kill_the_late() {
  for (auto& [pid, run] : runs_) {
    if (run.too_long || !run.limit || Clock::now() - run.begin < *run.limit) continue;
    run.too_long = true;
    kill(pid, SIGKILL);
  }
}

Ended Children::ended(const Run& run, int status) {
  const int exit = WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
  const bool killed = run.too_long && !WIFEXITED(status);  // it may have ended in the same moment
  Ended ended{run.job, exit, end_of(run.output), Seconds(Clock::now() - run.begin).count(), killed};
  close(run.output);
  return ended;
}

void Children::terminate() const {
  for (const auto& [pid, run] : runs_) kill(pid, SIGTERM);
}

}  // namespace dsdpv1::tb::campaign

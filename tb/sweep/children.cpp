#include "tb/sweep/children.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "tb/scenario/input_error.hpp"

namespace tb::sweep {
namespace {

constexpr const char* kThisProgram = "/proc/self/exe";  // also when the file was replaced meanwhile
constexpr int kSignalled = 128;
constexpr std::chrono::milliseconds kMoment(10);

class FileActions {
 public:
  explicit FileActions(const std::string& errors) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

}  // namespace

Children::~Children() {
  terminate();
  while (running() != 0) wait();
}

void Children::start(std::size_t point, const std::vector<std::string>& arguments, const std::string& errors) {
  std::vector<std::string> words = {"dsdpv1-sim"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const FileActions actions(errors);
  pid_t pid = 0;
  const int failed = posix_spawn(&pid, kThisProgram, actions.get(), nullptr, argv.data(), environ);
  if (failed != 0)
    throw InputError(std::string("dsdpv1-sim sweep: no process can be started: ") + std::strerror(failed));
  points_[pid] = point;
}

std::optional<Ended> Children::wait() {
  int status = 0;
  const pid_t pid = waitpid(-1, &status, WNOHANG);
  const auto found = points_.find(pid);
  if (found == points_.end()) {
    std::this_thread::sleep_for(kMoment);
    return std::nullopt;
  }
  const Ended ended{found->second, WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status)};
  points_.erase(found);
  return ended;
}

void Children::terminate() const {
  for (const auto& [pid, point] : points_) kill(pid, SIGTERM);
}

}  // namespace tb::sweep

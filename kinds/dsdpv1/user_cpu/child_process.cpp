#include "kinds/dsdpv1/user_cpu/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace dsdpv1::user_cpu {
namespace {

constexpr int kItsSocket = 3;  ///< the program's number of its end

[[noreturn]] void fail(int code, const std::string& what) {
  throw std::system_error(code, std::generic_category(), what);
}

/// The host's environment with the socket's number.
std::vector<std::string> environment(const std::string& variable) {
  std::vector<std::string> all;
  for (char** each = environ; *each != nullptr; ++each)
    if (std::string(*each).rfind(variable + "=", 0) != 0) all.emplace_back(*each);
  all.push_back(fmt::format("{}={}", variable, kItsSocket));
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::string& variable) {
  std::array<int, 2> ends{}, output{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) fail(errno, "socketpair");
  socket_.reset(ends[0]);
  const tb::Descriptor its_socket(ends[1]);
  if (::pipe2(output.data(), O_CLOEXEC) != 0) fail(errno, "pipe2");
  output_.reset(output[0]);
  const tb::Descriptor its_output(output[1]);
  ::fcntl(output_.get(), F_SETFL, O_NONBLOCK);
  start(arguments, variable, its_socket.get(), its_output.get());
}

/// dup2 onto itself keeps close-on-exec: the ends are moved above the numbers that they get.
void ChildProcess::start(const std::vector<std::string>& arguments, const std::string& variable, int its_socket,
                         int its_output) {
  const tb::Descriptor moved(::fcntl(its_socket, F_DUPFD_CLOEXEC, kItsSocket + 1));
  if (!moved) fail(errno, "fcntl");
  std::vector<std::string> words = arguments, variables = environment(variable);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, its_output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, moved.get(), kItsSocket);
  const int error =
      ::posix_spawn(&pid_, words[0].c_str(), &actions, nullptr, pointers(words).data(), pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) fail(error, words[0]);
}

ChildProcess::~ChildProcess() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

/// Takes the output meanwhile: a program whose pipe is full waits.
bool ChildProcess::readable(int patience_ms) {
  std::array<pollfd, 2> wanted = {{{socket_.get(), POLLIN, 0}, {output_.get(), POLLIN, 0}}};
  const int ready = ::poll(wanted.data(), wanted.size(), patience_ms == 0 ? -1 : patience_ms);
  if (wanted[1].revents != 0) take_output();
  return ready != 0;
}

ChildProcess::Got ChildProcess::receive(void* bytes, std::size_t n, int patience_ms) {
  for (char* at = static_cast<char*>(bytes); n != 0;) {
    const ssize_t received = ::recv(socket_.get(), at, n, MSG_DONTWAIT);
    if (received > 0) {
      at += received;
      n -= static_cast<std::size_t>(received);
    } else if (received == 0 || (errno != EAGAIN && errno != EINTR)) {
      return Got::kEnd;
    } else if (!readable(patience_ms)) {
      return Got::kLate;
    }
  }
  return Got::kAll;
}

bool ChildProcess::send(const void* bytes, std::size_t n) {
  for (const char* at = static_cast<const char*>(bytes); n != 0;) {
    const ssize_t sent = ::send(socket_.get(), at, n, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    at += sent;
    n -= static_cast<std::size_t>(sent);
  }
  return true;
}

void ChildProcess::take_output() {
  std::array<char, 4096> piece{};
  ssize_t n = 0;
  while ((n = ::read(output_.get(), piece.data(), piece.size())) > 0)
    text_.append(piece.data(), static_cast<std::size_t>(n));
  if (n == 0) output_.reset();  // it has closed its stdout
}

void ChildProcess::lines(const std::function<void(const std::string&)>& each) {
  take_output();
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = text_.find('\n', begin)) != std::string::npos; begin = end + 1)
    each(text_.substr(begin, end - begin));
  text_.erase(0, begin);
}

std::filesystem::path ChildProcess::program() const {
  std::error_code error;
  return std::filesystem::read_symlink(fmt::format("/proc/{}/exe", pid_), error);
}

std::string ChildProcess::ending() {
  int status = 0;
  ::waitpid(pid_, &status, 0);
  pid_ = -1;
  if (WIFSIGNALED(status))
    return fmt::format("was ended by signal {}, {}", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
  return fmt::format("has ended with exit code {}", WEXITSTATUS(status));
}

}  // namespace dsdpv1::user_cpu

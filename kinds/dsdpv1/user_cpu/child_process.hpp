#pragma once
// A program of the host as a child process: a socket to talk to it, and the lines that it writes to stdout.
#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "io/input/descriptor.hpp"

namespace dsdpv1::user_cpu {

/// Neither copied nor moved; used from one thread.
class ChildProcess {
 public:
  /// Starts `arguments`, of which the first is the program's path; its end of the socket is in the environment variable
  /// `variable`. Throws std::system_error if that is not possible.
  ChildProcess(const std::vector<std::string>& arguments, const std::string& variable);
  /// Ends the program.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  enum class Got : std::uint8_t { kAll, kEnd, kLate };
  /// Receives `n` bytes. kLate: `patience_ms` of the host's time have passed without one; 0: never.
  Got receive(void* bytes, std::size_t n, int patience_ms);
  /// False: the program has ended.
  bool send(const void* bytes, std::size_t n);
  /// Calls `each` for the lines written to stdout since the last call.
  void lines(const std::function<void(const std::string&)>& each);
  /// The file that it runs; another one than was started if that has started it in its place. Empty: not known.
  std::filesystem::path program() const;
  /// Waits for the end of a program that has closed the socket: "has ended with exit code 3".
  std::string ending();

 private:
  void start(const std::vector<std::string>& arguments, const std::string& variable, int its_socket, int its_output);
  bool readable(int patience_ms);
  void take_output();

  pid_t pid_ = -1;
  tb::Descriptor socket_, output_;
  std::string text_;  ///< written to stdout, from the begin of a line on
};

}  // namespace dsdpv1::user_cpu

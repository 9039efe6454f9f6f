#pragma once
// SystemC has one time resolution, one quantum and one simulation per process: comparisons need further processes.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace dsdpv1 {

/// The first line that differs, of both texts; empty when they are the same. For texts too long for EXPECT_EQ.
inline std::string first_difference(const std::string& a, const std::string& b) {
  if (a == b) return "";
  std::istringstream in_a(a), in_b(b);
  std::string line_a, line_b;
  for (int number = 1;; ++number) {
    const bool more = static_cast<bool>(std::getline(in_a, line_a)),
               more_b = static_cast<bool>(std::getline(in_b, line_b));
    if (!more || !more_b || line_a != line_b)
      return "line " + std::to_string(number) + ": " + (more ? line_a : "the end") + " / " +
             (more_b ? line_b : "the end");
  }
}

/// Never returns: the tests after `body` belong to the parent process.
[[noreturn]] inline void answer(const std::function<std::string()>& body, std::FILE* file) {
  try {
    const std::string text = body();
    const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
    _exit(written ? EXIT_SUCCESS : EXIT_FAILURE);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    _exit(EXIT_FAILURE);
  }
}

/// The result of `body`, called in a process that starts as a copy of this one and ends after the call. Throws when the
/// process ends otherwise.
inline std::string in_a_process_of_its_own(const std::function<std::string()>& body) {
  std::FILE* file = std::tmpfile();
  if (file == nullptr) throw std::runtime_error("no temporary file");
  const pid_t child = fork();
  if (child == 0) answer(body, file);
  int status = 0;
  waitpid(child, &status, 0);
  std::string text;
  if (std::fseek(file, 0, SEEK_SET) != 0) throw std::runtime_error("the temporary file cannot be read");
  for (int character = std::fgetc(file); character != EOF; character = std::fgetc(file))
    text += static_cast<char>(character);
  std::fclose(file);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != EXIT_SUCCESS) throw std::runtime_error("the other process failed");
  return text;
}

}  // namespace dsdpv1

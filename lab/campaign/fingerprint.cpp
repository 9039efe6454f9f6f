#include "lab/campaign/fingerprint.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "io/input/descriptor.hpp"
#include "io/input/hash.hpp"
#include "io/input/input_error.hpp"
#include "io/input/read_file.hpp"

namespace dsdpv1::tb::campaign {
namespace {

constexpr std::size_t kMostMb = 1024;  // of a result

std::string text_of(const Hash& hash) { return fmt::format("{:016x}", hash.value()); }

/// Errors that concern the path, not the machine's state.
bool of_the_path(int error) {
  return error == ENOENT || error == ENOTDIR || error == EACCES || error == EISDIR || error == ELOOP ||
         error == ENAMETOOLONG;
}

[[noreturn]] void fail(const std::string& path) {
  throw InputError(path, 0, std::string("cannot be read now: ") + std::strerror(errno));
}

}  // namespace

std::string fingerprint(const std::string& text) {
  Hash hash;
  hash.add(text);
  return text_of(hash);
}

std::string program_identity(const std::string& version) {
  return version + " " + fingerprint_of_file("/proc/self/exe").value_or("");
}

std::optional<std::string> fingerprint_of_file(const std::string& path) {
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));  // does not wait for a FIFO's writer
  struct stat status {};
  if (file.get() < 0 && of_the_path(errno)) return std::nullopt;
  if (file.get() < 0 || fstat(file.get(), &status) != 0) fail(path);
  if (S_ISDIR(status.st_mode)) return std::nullopt;
  if (!S_ISREG(status.st_mode))
    throw InputError(path, 0, "is no regular file, allowed here is one that every run can read again");
  Hash hash;
  std::array<char, 65536> block{};
  for (;;) {
    const ssize_t count = read(file.get(), block.data(), block.size());
    if (count < 0 && errno != EINTR) fail(path);
    if (count == 0) return text_of(hash);
    if (count > 0) hash.add(std::string_view(block.data(), static_cast<std::size_t>(count)));
  }
}

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "";
  const std::size_t before = text.rfind('\n', end);  // npos + 1 is the beginning
  return text.substr(before + 1, end - before);
}

std::string content(const std::string& path) { return try_read_file(path, kMostMb).text; }

nlohmann::ordered_json read_json(const std::string& path) {
  return nlohmann::ordered_json::parse(content(path), nullptr, false);
}

std::string text_of(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

nlohmann::ordered_json as_kept(const nlohmann::ordered_json& json) {
  return nlohmann::ordered_json::parse(text_of(json));
}

}  // namespace dsdpv1::tb::campaign

#include "io/input/read_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include "io/input/descriptor.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"

namespace dsdpv1::tb {
namespace {

constexpr const char* kAbsent = "no such file";

/// 0, or errno. Reads at most `most` bytes and one more, which shows that there is more.
int read_all(int fd, std::size_t most, std::string& text) {
  std::array<char, 65536> piece{};
  while (text.size() <= most) {
    const ssize_t count = ::read(fd, piece.data(), std::min(piece.size(), most + 1 - text.size()));
    if (count < 0) return errno;
    if (count == 0) return 0;
    text.append(piece.data(), static_cast<std::size_t>(count));
  }
  return 0;
}

/// See provide_file.
std::map<std::string, std::string>& provided() {
  static std::map<std::string, std::string> files;
  return files;
}

}  // namespace

void provide_file(const std::string& path, std::string text) { provided()[path] = std::move(text); }

std::string what_is_wrong(int error) {
  if (error == ENOENT || error == ENOTDIR) return kAbsent;
  if (error == EISDIR) return "is a folder";
  return fmt::format("cannot be read ({})", std::generic_category().message(error));
}

ReadFile try_read_file(const std::string& path, std::size_t most_mb) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) {
    const int error = errno;
    const auto instead = provided().find(path);
    const bool absent = error == ENOENT || error == ENOTDIR;
    return absent && instead != provided().end() ? ReadFile{instead->second, ""} : ReadFile{"", what_is_wrong(error)};
  }
  const std::size_t most = most_mb << 20U;
  ReadFile result;
  if (const int error = read_all(file.get(), most, result.text); error != 0) return {"", what_is_wrong(error)};
  if (result.text.size() > most) return {"", fmt::format("is larger than {} MB", most_mb)};
  return result;
}

std::string nearest_file(const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path wanted(path), folder = wanted.parent_path();
  std::vector<std::string> stems, endings;
  std::error_code error;
  for (fs::directory_iterator each(folder.empty() ? "." : folder, error), end; !error && each != end;
       each.increment(error))
    if (each->path().stem() == wanted.stem())
      endings.push_back(each->path().extension());
    else if (each->path().extension() == wanted.extension())
      stems.push_back(each->path().stem());
  std::sort(stems.begin(), stems.end());
  const std::string ending = nearest(wanted.extension(), endings), stem = nearest(wanted.stem(), stems);
  if (!ending.empty()) return (folder / (wanted.stem().string() + ending)).string();
  return stem.empty() ? "" : (folder / (stem + wanted.extension().string())).string();
}

namespace {

std::string did_you_mean_file(const std::string& path) {
  const std::string file = nearest_file(path);
  return file.empty() ? "" : " (did you mean " + file + "?)";
}

}  // namespace

std::string read_file(const std::string& path, const FileKind& kind) {
  ReadFile file = try_read_file(path, kind.most_mb);
  if (file.wrong == kAbsent) file.wrong += did_you_mean_file(path);
  if (!file.wrong.empty()) throw InputError(path, 0, fmt::format("{}, expected {}", file.wrong, kind.what));
  return std::move(file.text);
}

}  // namespace dsdpv1::tb

#include "io/output/part_file.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <climits>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <utility>

#include "io/output/signals_held.hpp"

namespace dsdpv1::tb {
namespace {

constexpr mode_t kPermissions = 0777;

/// Names of open temporary files; lock-free, for handlers. Only its owner removes a name without a slot.
std::array<std::atomic<const char*>, 64> slots{};

int take_slot(const char* name) {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const char* none = nullptr;
    if (slots.at(i).compare_exchange_strong(none, name)) return static_cast<int>(i);
  }
  return -1;
}

/// The beginning of a name that leaves room for `more` characters, cut between characters of UTF-8.
std::string cut(std::string name, std::size_t more) {
  if (name.size() + more <= NAME_MAX) return name;
  name.resize(NAME_MAX - more);
  while (!name.empty() && (static_cast<unsigned char>(name.back()) & 0xC0U) == 0x80U) name.pop_back();
  if (!name.empty() && static_cast<unsigned char>(name.back()) >= 0xC0U) name.pop_back();
  return name;
}

std::string part_name(const std::string& target, int attempt) {
  const std::string again = attempt == 0 ? "" : "-" + std::to_string(attempt);
  const std::string ending = "." + std::to_string(::getpid()) + again + PartFile::kEnding;
  return folder_of(target) + "/" + cut(name_of(target), ending.size() + PartFile::kRoom) + ending;
}

/// Without "./" in front, which the user did not write.
std::string as_written(const std::string& name, const std::string& target) {
  return target.find('/') == std::string::npos ? name.substr(2) : name;
}

struct NewFile {
  std::string name;
  int descriptor;
};

/// A name that is there already was left by a process with this one's number, or belongs to another computer.
NewFile create(const OutputPlace& place) {
  for (int attempt = 0;; ++attempt) {
    std::string name = as_written(part_name(place.target, attempt), place.target);
    const int descriptor = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return {std::move(name), descriptor};
    if (errno != EEXIST) refuse_output(place.wanted, errno);
  }
}

void keep_owner_and_mode(int descriptor, const struct stat& replaced) {
  // Only root may give files away, and a group may not be ours: then the file belongs to its writer.
  const bool same = ::fchown(descriptor, replaced.st_uid, replaced.st_gid) == 0;
  ::fchmod(descriptor, replaced.st_mode & (same ? 07777 : kPermissions));
}

int open_directly(const OutputPlace& place) {
  const int descriptor = place.descriptor >= 0 ? ::fcntl(place.descriptor, F_DUPFD_CLOEXEC, 3)
                                               : ::open(place.target.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
  if (descriptor < 0) refuse_output(place.wanted, errno);
  return descriptor;
}

std::unique_ptr<NameToRemove> open_place(const OutputPlace& place, int& descriptor) {
  if (place.direct) {
    descriptor = open_directly(place);
    return std::make_unique<NameToRemove>("");
  }
  const SignalsHeld held;  // between creating the file and noting its name
  NewFile made = create(place);
  descriptor = made.descriptor;
  auto part = std::make_unique<NameToRemove>(std::move(made.name));
  if (place.replaced) keep_owner_and_mode(descriptor, *place.replaced);
  return part;
}

}  // namespace

NameToRemove::NameToRemove(std::string name) : name_(std::move(name)) {
  if (!name_.empty()) slot_ = take_slot(name_.c_str());
}

NameToRemove::~NameToRemove() {
  if (slot_ >= 0) slots.at(static_cast<std::size_t>(slot_)).store(nullptr);
}

void remove_parts() noexcept {
  for (const std::atomic<const char*>& slot : slots)
    if (const char* const name = slot.load()) ::unlink(name);
}

PartFile::PartFile(const std::string& path) : place_(find_place(path)), part_(open_place(place_, descriptor_)) {}

PartFile::~PartFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!placed_ && !direct()) ::unlink(part().c_str());
}

int PartFile::take_descriptor() { return std::exchange(descriptor_, -1); }

void PartFile::place() {
  if (!direct() && std::rename(part().c_str(), place_.target.c_str()) != 0) refuse_output(path(), errno);
  placed_ = true;
}

}  // namespace dsdpv1::tb

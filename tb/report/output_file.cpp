#include "tb/report/output_file.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include "tb/scenario/input_error.hpp"

namespace tb {

std::string part_name(const std::string& path) { return path + ".part"; }

void rename_part(const std::string& part, const std::string& path) {
  if (std::rename(part.c_str(), path.c_str()) == 0) return;
  const std::string reason = std::strerror(errno);
  std::remove(part.c_str());
  throw InputError(path, 0, "cannot be written: " + reason);
}

OutputFile::OutputFile(std::string path)
    : path_(std::move(path)), part_(part_name(path_)), file_(std::fopen(part_.c_str(), "wb")) {
  if (!file_) throw InputError(path_, 0, std::string("cannot be written: ") + std::strerror(errno));
}

OutputFile::~OutputFile() {
  if (!file_) return;
  file_.reset();
  std::remove(part_.c_str());
}

void OutputFile::commit() {
  const bool failed = std::fflush(file_.get()) != 0 || std::ferror(file_.get()) != 0;
  const std::string reason = failed ? std::strerror(errno) : "";
  file_.reset();
  if (failed) {
    std::remove(part_.c_str());
    throw InputError(path_, 0, "cannot be written: " + reason);
  }
  rename_part(part_, path_);
}

}  // namespace tb

#include "io/output/output_file.hpp"

#include <cerrno>

#include "io/output/nowhere.hpp"

namespace dsdpv1::tb {

OutputFile::OutputFile(const std::string& path) : part_(path), file_(::fdopen(part_.take_descriptor(), "wb")) {
  if (!file_) refuse_output(path, errno);
}

void OutputFile::keep_error() { error_ = errno != 0 ? errno : EIO; }

void OutputFile::flush() {
  if (error_ == 0 && std::fflush(file_.get()) != 0) keep_error();
}

void OutputFile::mute() {
  if (!send_nowhere(::fileno(file_.get()))) refuse_output("/dev/null", errno);
}

void OutputFile::check() const {
  if (failed()) refuse_output(path(), error_);
}

void OutputFile::commit() {
  flush();
  if (std::fclose(file_.release()) != 0 && error_ == 0) keep_error();
  check();
  part_.place();
}

}  // namespace dsdpv1::tb

#pragma once
// A file that is complete or absent: it is written under a temporary name beside its place and renamed by `commit`.
// Symbolic links are followed; devices and FIFOs are written to as they are.
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "io/output/part_file.hpp"

namespace dsdpv1::tb {

class OutputFile {
 public:
  /// Throws InputError when the file cannot be created.
  explicit OutputFile(const std::string& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Without a commit no file remains.
  ~OutputFile() = default;

  /// The first error (a full disk) is kept; after it nothing more is written.
  void write(std::string_view text) {
    if (error_ == 0 && std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) keep_error();
  }
  /// Puts all output so far into the file with the temporary name.
  void flush();
  /// Discards later output: for a process that shares the file with its owner. Throws InputError when /dev/null cannot
  /// be opened.
  void mute();
  /// True when a write has failed: then a run need not continue.
  bool failed() const { return error_ != 0; }
  /// Throws InputError when a write has failed.
  void check() const;
  /// Closes and gives the file its name; throws InputError when a write has failed.
  void commit();
  const std::string& path() const { return part_.path(); }
  /// The path of the growing file: the temporary name, or the device itself.
  const std::string& grows_at() const { return part_.direct() ? part_.path() : part_.part(); }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void keep_error();

  PartFile part_;
  std::unique_ptr<std::FILE, Close> file_;  // closed before the temporary name is removed
  int error_ = 0;
};

}  // namespace dsdpv1::tb

#pragma once
// A file that is complete or absent: it is written under a temporary name beside its place and renamed by `commit`.
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace tb {

class OutputFile {
 public:
  /// Throws InputError when the file cannot be created.
  explicit OutputFile(std::string path);
  /// Without a commit nothing is left behind.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Errors (a full disk) are kept until `commit`.
  void write(std::string_view text) { std::fwrite(text.data(), 1, text.size(), file_.get()); }
  /// What was written so far is in the file with the temporary name.
  void flush() { std::fflush(file_.get()); }
  /// Closes and gives the file its name; throws InputError when something could not be written.
  void commit();
  const std::string& path() const { return path_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string path_, part_;
  std::unique_ptr<std::FILE, Close> file_;
};

/// The temporary name of an output file: in the same folder, so that renaming is atomic.
std::string part_name(const std::string& path);
/// Renames `part` to `path`; throws InputError and removes `part` when that fails.
void rename_part(const std::string& part, const std::string& path);

}  // namespace tb

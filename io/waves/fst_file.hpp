#pragma once
// An FST file under construction: fstapi with its errors, a temporary name, and blocks that are on disk when the
// process is killed.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/output/part_file.hpp"

namespace dsdpv1::tb {

class FstFile {
 public:
  using Handle = std::uint32_t;

  enum class Kind { kUsual, kReal, kEvent };

  /// Times count 10^exponent seconds. Throws InputError when it cannot be created, or is a device or FIFO: FST is not
  /// written sequentially.
  FstFile(const std::string& path, const std::string& date, int exponent = -12);
  /// Removes an unfinished file.
  ~FstFile();
  FstFile(const FstFile&) = delete;
  FstFile& operator=(const FstFile&) = delete;

  void open_scope(const std::string& name);
  void close_scope();
  /// `width` 0: values are words. `alias`: one more name for this one. Usual is a wire, or words.
  Handle variable(const std::string& name, std::uint32_t width, Handle alias = 0, Kind kind = Kind::kUsual);
  /// Time of the changes that follow; never decreases.
  void move_to(std::uint64_t time);
  /// `levels`: as many characters 0, 1, x, z as the wire is wide; one of an event; of a real the bytes of a double.
  void set(Handle variable, const char* levels);
  void say(Handle variable, std::string_view word);

  /// Puts all changes up to now, `time`, into the temporary file, where recover finds them.
  void save(std::uint64_t time);
  bool failed() const { return error_ != 0; }
  /// Throws InputError when a write has failed.
  void check() const;
  /// Gives the complete file its name; throws InputError.
  void finish();
  const std::string& grows_at() const { return part_.part(); }

 private:
  void* create();
  void close();
  void keep_error();
  void begin_block();
  void end_block();
  void count_change();

  PartFile part_;
  NameToRemove declarations_;  ///< the second file of fstapi, until this one is closed
  int error_ = 0;
  void* context_;
  std::optional<std::uint64_t> time_;
  unsigned changes_ = 0;     ///< of the block
  unsigned steps_ = 0;       ///< changes of time in it; fstapi needs more than one
  bool ends_block_ = false;  ///< at the next change of time
};

}  // namespace dsdpv1::tb

#pragma once
// The output of a function that is called in a separate process: for a library that ends the program, or worse, when a
// file is damaged. At most a buffer and a pipe of the output are in memory.
#include <sys/types.h>

#include <cstdio>
#include <cstring>
#include <functional>
#include <type_traits>
#include <vector>

#include "io/input/descriptor.hpp"

namespace dsdpv1::tb {

class ChildStream {
 public:
  /// Throws std::system_error when no process can be created.
  explicit ChildStream(const std::function<void(std::FILE*)>& tell);
  /// Kills the process.
  ~ChildStream();
  ChildStream(const ChildStream&) = delete;
  ChildStream& operator=(const ChildStream&) = delete;

  /// False when the process has ended before.
  bool read(char* to, std::size_t size) {
    if (size > have_ - at_) return read_more(to, size);
    std::memcpy(to, buffer_.data() + at_, size);
    at_ += size;
    return true;
  }
  template <class Record>
  bool read(Record& record) {
    static_assert(std::is_trivially_copyable_v<Record>);
    return read(reinterpret_cast<char*>(&record), sizeof record);
  }

 private:
  bool read_more(char* to, std::size_t size);

  Descriptor pipe_;
  pid_t child_ = -1;
  std::vector<char> buffer_;
  std::size_t at_ = 0, have_ = 0;
};

}  // namespace dsdpv1::tb

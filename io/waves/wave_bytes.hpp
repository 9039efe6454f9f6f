#pragma once
// The bytes of a wave's file or FIFO; those of a gz are unpacked.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "io/input/descriptor.hpp"

namespace dsdpv1::tb {

class WaveBytes {
 public:
  /// Throws InputError if it cannot be read, or is packed and this program was built without zlib.
  explicit WaveBytes(const std::string& path);
  ~WaveBytes();
  WaveBytes(WaveBytes&&) noexcept;
  WaveBytes& operator=(WaveBytes&&) = delete;

  /// Up to `size` bytes, at least one before the end; 0 at the end. Throws InputError, also for a gz that is damaged or
  /// cut.
  std::size_t read(char* to, std::size_t size);
  bool packed() const { return unpacker_ != nullptr; }
  /// Bytes of the file as it is; 0 of a FIFO.
  std::uint64_t size() const { return size_; }
  /// Bytes of the file that were read so far.
  std::uint64_t taken() const { return taken_; }

 private:
  struct Unpacker;
  std::size_t take(char* to, std::size_t size);
  std::size_t unpack(char* to, std::size_t size);
  bool refill();

  std::string path_;
  Descriptor file_;
  std::string input_;   ///< the beginning of the file; of a gz its last piece
  std::size_t at_ = 0;  ///< in the beginning
  std::unique_ptr<Unpacker> unpacker_;
  std::uint64_t size_ = 0, taken_ = 0;
};

/// The form of a wave that this program does not read, and what to do, by its first bytes; empty: another one.
std::string foreign_form(const char* bytes, std::size_t size);

}  // namespace dsdpv1::tb

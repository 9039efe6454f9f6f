#pragma once
// A stream whose beginning was looked at and is there again; also a pipe, which cannot go back.
#include <array>
#include <istream>
#include <streambuf>
#include <string_view>

namespace dsdpv1::app {

class RewoundInput {
 public:
  /// Reads the beginning of `in`, which must outlive it.
  explicit RewoundInput(std::istream& in) : buffer_(in), stream_(&buffer_) {}

  /// Up to kBeginning bytes.
  std::string_view beginning() const { return buffer_.beginning(); }
  /// All of the input, with its beginning.
  std::istream& stream() { return stream_; }

  static constexpr std::size_t kBeginning = 4096;

 private:
  class Buffer : public std::streambuf {
   public:
    explicit Buffer(std::istream& in) : in_(in) { fill(kBeginning); }
    std::string_view beginning() const { return {bytes_.data(), size_}; }

   protected:
    int_type underflow() override {
      if (gptr() == egptr()) fill(bytes_.size());
      if (in_.bad()) throw std::ios_base::failure("cannot be read");  // the stream of this buffer is bad then
      return gptr() == egptr() ? traits_type::eof() : traits_type::to_int_type(*gptr());
    }

   private:
    void fill(std::size_t most) {
      in_.read(bytes_.data(), static_cast<std::streamsize>(most));
      size_ = static_cast<std::size_t>(in_.gcount());
      setg(bytes_.data(), bytes_.data(), bytes_.data() + size_);
    }

    std::istream& in_;
    std::array<char, 16'384> bytes_{};
    std::size_t size_ = 0;
  };

  Buffer buffer_;
  std::istream stream_;
};

}  // namespace dsdpv1::app

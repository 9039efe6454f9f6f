#pragma once
// Standard output that keeps its first error, so that a full disk or a closed pipe is reported at the end.
#include <array>
#include <streambuf>

namespace dsdpv1::tb {

class StandardOutput : public std::streambuf {
 public:
  /// Replaces std::cout's buffer until the program ends.
  StandardOutput();
  ~StandardOutput() override;
  StandardOutput(const StandardOutput&) = delete;
  StandardOutput& operator=(const StandardOutput&) = delete;

  /// Writes the rest; returns 0 or the first error (errno). EPIPE: the reader has closed the pipe.
  int finish();

 protected:
  int_type overflow(int_type character) override;
  int sync() override;

 private:
  /// False after an error; later output is discarded.
  bool write_out();

  std::array<char, 1U << 14U> text_{};
  std::streambuf* before_;
  int error_ = 0;
};

/// Replaces closed standard channels by descriptors that can neither be read nor written. Otherwise the first opened
/// file would get their number, and the program's messages would go into it.
void fill_closed_channels();

}  // namespace dsdpv1::tb

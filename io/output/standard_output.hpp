#pragma once
// Standard output that keeps its first error, so that a full disk or a reader that has gone away is seen at the end.
#include <array>
#include <streambuf>

namespace dsdpv1::tb {

class StandardOutput : public std::streambuf {
 public:
  /// Takes the place of std::cout's buffer, until the program ends.
  StandardOutput();
  ~StandardOutput() override;
  StandardOutput(const StandardOutput&) = delete;
  StandardOutput& operator=(const StandardOutput&) = delete;

  /// Writes what is left; 0, or the first error (errno). EPIPE: the reader has gone away.
  int finish();

 protected:
  int_type overflow(int_type character) override;
  int sync() override;

 private:
  /// False after an error; what comes then is thrown away.
  bool write_out();

  std::array<char, 1U << 14U> text_{};
  std::streambuf* before_;
  int error_ = 0;
};

/// Puts something that can neither be read nor written in the place of standard channels that are closed. Otherwise the
/// first file that is opened would get their number, and what the program says would go into it.
void fill_closed_channels();

}  // namespace dsdpv1::tb

#include "apps/printable_output.hpp"

#include <iostream>
#include <streambuf>
#include <string>

#include "bus/printable.hpp"

namespace app {

/// Passes on whole lines, and what there is of one when it is flushed: a letter of several bytes must come in one
/// piece.
class PrintableOutput::Filter : public std::streambuf {
 public:
  explicit Filter(std::ostream& stream) : stream_(stream), to_(stream.rdbuf(this)) {}
  ~Filter() override {
    pass_on(waiting_.size());
    stream_.rdbuf(to_);
  }
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;

 protected:
  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char character = traits_type::to_char_type(c);
    return xsputn(&character, 1) == 1 ? c : traits_type::eof();
  }
  std::streamsize xsputn(const char* text, std::streamsize count) override {
    waiting_.append(text, static_cast<std::size_t>(count));
    const std::size_t end = waiting_.rfind('\n');
    return end == std::string::npos || pass_on(end + 1) ? count : 0;
  }
  int sync() override {
    const bool passed = pass_on(waiting_.size());
    return to_->pubsync() == 0 && passed ? 0 : -1;
  }

 private:
  bool pass_on(std::size_t count) {
    const std::string text = bus::printable_lines(std::string_view(waiting_).substr(0, count));
    waiting_.erase(0, count);
    const auto size = static_cast<std::streamsize>(text.size());
    return to_->sputn(text.data(), size) == size;
  }

  std::ostream& stream_;
  std::streambuf* to_;
  std::string waiting_;
};

PrintableOutput::PrintableOutput()
    : out_(std::make_unique<Filter>(std::cout)), err_(std::make_unique<Filter>(std::cerr)) {}

PrintableOutput::~PrintableOutput() = default;

}  // namespace app

#include "apps/printable_output.hpp"

#include <algorithm>
#include <iostream>
#include <streambuf>
#include <string>
#include <string_view>
#include <utility>

#include "apps/terminal.hpp"
#include "bus/printable.hpp"

namespace dsdpv1::app {
namespace {

constexpr std::string_view kUsualName = "dsdpv1-sim", kUsualNameInRoff = "dsdpv1\\-sim";

}  // namespace

/// Passes on whole lines, and what there is of one when it is flushed: a letter of several bytes must come in one
/// piece.
class PrintableOutput::Filter : public std::streambuf {
 public:
  Filter(std::ostream& stream, std::string name) : stream_(stream), to_(stream.rdbuf(this)), name_(std::move(name)) {}
  ~Filter() override {
    pass_on(waiting_.size());
    stream_.rdbuf(to_);
  }
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;

  void paint() { paints_ = true; }

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
    std::string text = bus::printable_lines(std::string_view(waiting_).substr(0, count));
    if (name_ != kUsualName) text = renamed(std::move(text));
    if (paints_) text = painted_lines(text);
    waiting_.erase(0, count);
    const auto size = static_cast<std::streamsize>(text.size());
    return to_->sputn(text.data(), size) == size;
  }

  std::string renamed(std::string text) const {
    for (const std::string_view usual : {kUsualName, kUsualNameInRoff})
      for (std::size_t at = text.find(usual); at != std::string::npos; at = text.find(usual, at + name_.size()))
        text.replace(at, usual.size(), name_);
    return text;
  }

  /// If a line comes in pieces, only the first is checked.
  std::string painted_lines(const std::string& text) {
    std::string all;
    for (std::size_t from = 0; from < text.size();) {
      const std::size_t end = std::min(text.find('\n', from), text.size());
      const std::string line = text.substr(from, end - from);
      all += at_beginning_ ? painted(line) : line;
      at_beginning_ = end < text.size();
      if (at_beginning_) all += '\n';
      from = end + 1;
    }
    return all;
  }

  std::ostream& stream_;
  std::streambuf* to_;
  const std::string name_;
  std::string waiting_;
  bool paints_ = false, at_beginning_ = true;
};

PrintableOutput::PrintableOutput(const std::string& name)
    : out_(std::make_unique<Filter>(std::cout, name)), err_(std::make_unique<Filter>(std::cerr, name)) {}

PrintableOutput::~PrintableOutput() = default;

void PrintableOutput::paint() { out_->paint(); }

}  // namespace dsdpv1::app

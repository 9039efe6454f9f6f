#pragma once
// The error of all readers of input files: one line with the place, the fault and the allowed values.
#include <stdexcept>
#include <string>

namespace dsdpv1::tb {

/// "file:line: text", or "file: text" when `line` is 0, or "text" without a file (command line). Lines count
/// from 1.
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& file, int line, const std::string& text) : std::runtime_error(join(file, line, text)) {}
  explicit InputError(const std::string& text) : std::runtime_error(text) {}

 private:
  static std::string join(const std::string& file, int line, const std::string& text) {
    return line > 0 ? file + ":" + std::to_string(line) + ": " + text : file + ": " + text;
  }
};

}  // namespace dsdpv1::tb

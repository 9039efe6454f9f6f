#pragma once
// Converts the bytes of a GSD file to logical lines: encoding, comments, continuation, values wrapped over lines.
// Internal to the GSD reader.
#include <string>
#include <string_view>
#include <vector>

#include "bus/gsd/gsd.hpp"

namespace dsdpv1::bus::gsd {

/// Collects the remarks about one file.
class Diagnostics {
 public:
  explicit Diagnostics(std::string file) : file_(std::move(file)) {}
  void error(int line, std::string text) { add(GsdDiagnostic::Level::kError, line, std::move(text)); }
  void warning(int line, std::string text) { add(GsdDiagnostic::Level::kWarning, line, std::move(text)); }
  bool failed() const { return failed_; }
  /// Returns the remarks, ordered by line.
  std::vector<GsdDiagnostic> take();

 private:
  void add(GsdDiagnostic::Level level, int line, std::string text);
  std::string file_;
  std::vector<GsdDiagnostic> list_;
  bool failed_ = false;
};

struct Line {
  int number = 0;    ///< of the first physical line
  std::string text;  ///< without comment, trimmed, never empty
};

std::string_view trim(std::string_view text);
std::string lower(std::string_view text);

/// The whole file as UTF-8 text; reports bytes that no text file has. Empty if it is not text.
std::string decode(std::string bytes, Diagnostics& diagnostics);

/// Splits decoded text into logical lines. Reports unclosed strings (error) and non-standard habits (warning): `//`
/// comments, values on the line after a '=' or a comma.
std::vector<Line> logical_lines(const std::string& text, Diagnostics& diagnostics);

/// True for a text of numbers and commas only: a wrapped list or a module reference number.
bool is_number_list(std::string_view text);

}  // namespace dsdpv1::bus::gsd

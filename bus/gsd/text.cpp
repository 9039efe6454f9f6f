#include "bus/gsd/text.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace dsdpv1::bus::gsd {
namespace {

constexpr std::size_t kMaxDiagnostics = 200;  // garbage must not fill the screen or the memory
constexpr std::string_view kBlank = " \t\f\v\r\n";

/// Lines end with LF, CR LF or, from very old tools, CR alone.
std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find_first_of("\r\n");
    lines.push_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
    const bool crlf = text.compare(end, 2, "\r\n") == 0;
    text.remove_prefix(end + (crlf ? 2 : 1));
  }
  return lines;
}

bool ends_with(std::string_view text, char c) { return !text.empty() && text.back() == c; }

/// "Keyword =" or "Keyword(n) =": a line that cannot be the continuation of another.
bool starts_statement(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || text.empty() || std::isalnum(static_cast<unsigned char>(text.front())) == 0)
    return false;
  return text.substr(0, equals).find_first_of("\",") == std::string_view::npos;
}

class Splitter {
 public:
  Splitter(const std::string& text, Diagnostics& diagnostics) : physical_(split(text)), diagnostics_(diagnostics) {}

  std::vector<Line> run() {
    while (next_ < physical_.size()) read_line();
    return std::move(lines_);
  }

 private:
  /// One logical line: a physical one and its continuations by `\`.
  void read_line() {
    Line line{static_cast<int>(next_) + 1, {}};
    in_string_ = false;
    while (next_ < physical_.size()) {
      const bool more = append(line.text, physical_[next_], static_cast<int>(next_) + 1);
      ++next_;
      if (!more || !continuation_follows()) break;
    }
    if (in_string_) {
      diagnostics_.error(line.number, "the string is not closed, a closing \" before the end of the line is needed");
      return;
    }
    line.text = std::string(trim(line.text));
    if (!line.text.empty()) lines_.push_back(std::move(line));
  }

  /// Adds a physical line without its comment. Returns true if it ends with `\`.
  bool append(std::string& text, std::string_view physical, int number) {
    std::string_view code = trim(strip_comment(physical, number));
    if (!ends_with(code, '\\')) {
      text += code;
      return false;
    }
    code.remove_suffix(1);
    text += code;
    if (!in_string_) text += ' ';
    return true;
  }

  /// Removes the comment and tracks whether the position is inside a string.
  std::string_view strip_comment(std::string_view physical, int number) {
    for (std::size_t i = 0; i < physical.size(); ++i) {
      if (physical[i] == '"') in_string_ = !in_string_;
      if (in_string_) continue;
      if (physical[i] == ';') return physical.substr(0, i);
      if (physical.compare(i, 2, "//") == 0) {
        report_slashes(number);
        return physical.substr(0, i);
      }
    }
    return physical;
  }

  /// Reported once per file: one such comment is rarely alone.
  void report_slashes(int number) {
    if (!slashes_reported_) diagnostics_.warning(number, "// is taken for a comment, ; begins a comment in a GSD file");
    slashes_reported_ = true;
  }

  /// After a `\`: skips lines that contain only a comment. A blank line or a new statement shows that the `\` was a
  /// slip.
  bool continuation_follows() {
    if (in_string_) return next_ < physical_.size();
    while (next_ < physical_.size() && trim(physical_[next_]).substr(0, 1) == ";") ++next_;
    if (next_ < physical_.size() && !trim(physical_[next_]).empty() && !starts_statement(trim(physical_[next_])))
      return true;
    diagnostics_.warning(static_cast<int>(next_), "\\ at the end of the line, but no value follows");
    return false;
  }

  std::vector<std::string_view> physical_;
  Diagnostics& diagnostics_;
  std::size_t next_ = 0;
  bool in_string_ = false;
  bool slashes_reported_ = false;
  std::vector<Line> lines_;
};

bool begins_module(const std::string& text) { return lower(text.substr(0, 6)) == "module"; }

/// A single number after a Module whose list ends with a comma is its reference number, unless another one follows.
bool is_reference_number(const std::string& before, const std::vector<Line>& lines, std::size_t at) {
  const bool single = lines[at].text.find(',') == std::string::npos;
  const bool another = at + 1 < lines.size() && is_number_list(lines[at + 1].text);
  return begins_module(before) && single && !another;
}

bool is_wrapped(const std::string& before, const std::vector<Line>& lines, std::size_t at) {
  if (!is_number_list(lines[at].text)) return false;
  if (ends_with(before, '=') || lines[at].text.front() == ',') return true;
  return ends_with(before, ',') && !is_reference_number(before, lines, at);
}

/// Joins values wrapped without `\`, as left by a word processor or a careless editor.
std::vector<Line> join_wrapped(const std::vector<Line>& lines, Diagnostics& diagnostics) {
  std::vector<Line> result;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!result.empty() && is_wrapped(result.back().text, lines, i)) {
      diagnostics.warning(lines[i].number, "the value goes on from the line before, which must end with \\");
      result.back().text += " " + lines[i].text;
    } else {
      result.push_back(lines[i]);
    }
  }
  return result;
}

}  // namespace

void Diagnostics::add(GsdDiagnostic::Level level, int line, std::string text) {
  const bool error = level == GsdDiagnostic::Level::kError;
  const bool first_error = error && !failed_;
  failed_ = failed_ || error;
  if (list_.size() >= kMaxDiagnostics && !first_error) return;
  list_.push_back({level, file_, line, std::move(text)});
}

std::vector<GsdDiagnostic> Diagnostics::take() {
  std::stable_sort(list_.begin(), list_.end(), [](const auto& a, const auto& b) { return a.line < b.line; });
  return std::move(list_);
}

std::string_view trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

bool is_number_list(std::string_view text) {
  constexpr std::string_view kSeparators = ", \t";
  bool any = false;
  for (std::size_t at = text.find_first_not_of(kSeparators); at != std::string_view::npos;) {
    const std::string_view part = text.substr(at, text.find_first_of(kSeparators, at) - at);
    if (std::isdigit(static_cast<unsigned char>(part.front())) == 0) return false;
    if (part.find_first_not_of("0123456789abcdefABCDEFxX") != std::string_view::npos) return false;
    any = true;
    at = text.find_first_not_of(kSeparators, at + part.size());
  }
  return any;
}

std::vector<Line> logical_lines(const std::string& text, Diagnostics& diagnostics) {
  return join_wrapped(Splitter(text, diagnostics).run(), diagnostics);
}

}  // namespace dsdpv1::bus::gsd

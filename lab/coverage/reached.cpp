#include "lab/coverage/reached.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "io/input/input_error.hpp"
#include "io/input/units.hpp"

namespace dsdpv1::tb::coverage {
namespace {

constexpr std::array<const char*, 4> kWays = {"if", "else", "else if", "case"};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

/// Reads the numbers in a line that a program has written.
class Numbers {
 public:
  Numbers(std::string origin, int line, std::string expected)
      : origin_(std::move(origin)), line_(line), expected_(std::move(expected)) {}

  [[noreturn]] void fail() const { throw InputError(origin_, line_, "expected " + expected_); }
  Count count(const std::string& text) const {
    const auto number = parse_integer(text);
    if (!number || *number < 0) fail();
    return static_cast<Count>(*number);
  }
  int small(const std::string& text) const {
    constexpr Count kMost = 1'000'000;  // lines of a file, columns
    const Count number = count(text);
    if (number > kMost) fail();
    return static_cast<int>(number);
  }

 private:
  std::string origin_;
  int line_;
  std::string expected_;
};

template <class Key>
void add_counts(std::map<Key, Count>& sum, const std::map<Key, Count>& more) {
  for (const auto& [key, count] : more) sum[key] += count;
}

// --- Verilator -------------------------------------------------------------------------------------------------------

/// A record is C 'FIELDS' COUNT; each field is \1 KEY \2 VALUE.
using Fields = std::map<std::string, std::string>;

Fields fields_of(const std::string& text) {
  Fields fields;
  for (const std::string& field : split(text, '\1'))
    if (const std::size_t end = field.find('\2'); end != std::string::npos)
      fields[field.substr(0, end)] = field.substr(end + 1);
  return fields;
}

std::optional<Way> way_of(const std::string& word) {
  static const std::map<std::string, Way> ways = {
      {"if", Way::kIf}, {"else", Way::kElse}, {"elsif", Way::kElseIf}, {"case", Way::kCase}};
  const auto found = ways.find(word);
  return found == ways.end() ? std::nullopt : std::optional(found->second);
}

/// `lines`: "11-13,15".
void add_lines(Reached& reached, const std::string& lines, Count count, const Numbers& numbers) {
  for (const std::string& range : split(lines, ',')) {
    const std::size_t dash = range.find('-');
    const int first = numbers.small(range.substr(0, dash));
    const int last = dash == std::string::npos ? first : numbers.small(range.substr(dash + 1));
    for (int line = first; line <= last; ++line) reached.lines[line] += count;
  }
}

/// Later versions than 5.006 count the directions of a bit apart: "q[0]:0->1" and "q[0]:1->0". Here they are one.
std::string bit_of_toggle(const std::string& name) {
  const std::string ending = name.substr(std::min(name.rfind(':'), name.size()));
  return ending == ":0->1" || ending == ":1->0" ? name.substr(0, name.size() - ending.size()) : name;
}

void add_record(Files& files, Fields& fields, Count count, const Numbers& numbers) {
  const int line = numbers.small(fields["l"]);
  if (fields["f"].empty() || fields["page"].empty()) numbers.fail();
  Reached& reached = files[std::filesystem::absolute(fields["f"]).lexically_normal().string()];
  if (fields["page"].rfind("v_toggle", 0) == 0) {
    reached.points[{line, bit_of_toggle(fields["o"])}] += count;
    return;
  }
  if (const std::optional<Way> way = way_of(fields["o"]))
    reached.branches[{line, numbers.small(fields["n"]), *way}] += count;
  add_lines(reached, fields["S"], count, numbers);
}

// --- lcov ------------------------------------------------------------------------------------------------------------

/// Names of points for lcov, to which one of a file is as good as another of this name.
std::vector<std::string> names_of(const Reached& reached) {
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const auto& [point, count] : reached.points)
    names.push_back(known.insert(point.second).second ? point.second : fmt::format("{}@{}", point.second, point.first));
  return names;
}

/// "x@12" in line 12 is another x.
std::string without_line(const std::string& name, int line) {
  const std::string ending = fmt::format("@{}", line);
  const std::size_t rest = name.size() - std::min(name.size(), ending.size());
  return name.substr(rest) == ending ? name.substr(0, rest) : name;
}

std::string lcov(const std::string& path, const Reached& reached) {
  std::string text = "SF:" + path + "\n";
  const std::vector<std::string> names = names_of(reached);
  const auto total = [&text](const char* kind, const auto& counts) {
    if (!counts.empty()) text += fmt::format("{0}F:{1}\n{0}H:{2}\n", kind, counts.size(), reached_of(counts));
  };
  auto name = names.begin();
  for (const auto& [point, count] : reached.points) text += fmt::format("FN:{},{}\n", point.first, *name++);
  name = names.begin();
  for (const auto& [point, count] : reached.points) text += fmt::format("FNDA:{},{}\n", count, *name++);
  total("FN", reached.points);
  for (const auto& [branch, count] : reached.branches)
    text += fmt::format("BRDA:{},{},{},{}\n", std::get<0>(branch), std::get<1>(branch),
                        static_cast<int>(std::get<2>(branch)), count);
  total("BR", reached.branches);
  for (const auto& [line, count] : reached.lines) text += fmt::format("DA:{},{}\n", line, count);
  return text + fmt::format("LF:{}\nLH:{}\nend_of_record\n", reached.lines.size(), reached_of(reached.lines));
}

/// A tracefile is read line by line; the counts of a file's points come after all their lines.
class Reader {
 public:
  explicit Reader(Files& files) : files_(files) {}

  void line(const std::string& text, const Numbers& numbers) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string word = text.substr(0, colon), rest = text.substr(std::min(colon + 1, text.size()));
    if (word == "SF") begin(rest);
    if (word == "end_of_record") reached_ = nullptr;
    if (word != "FN" && word != "FNDA" && word != "DA" && word != "BRDA") return;  // TN, sums, the end
    const std::size_t comma = rest.find(',');
    if (reached_ == nullptr || comma == std::string::npos) numbers.fail();
    const std::string first = rest.substr(0, comma), second = rest.substr(comma + 1);
    if (word == "FN") lines_[second] = numbers.small(first);
    if (word == "FNDA") point(second, numbers.count(first), numbers);
    if (word == "DA") reached_->lines[numbers.small(first)] += numbers.count(second);
    if (word == "BRDA") branch(numbers.small(first), split(second, ','), numbers);
  }

 private:
  void begin(const std::string& path) {
    reached_ = &files_[path];
    lines_.clear();
  }
  void point(const std::string& name, Count count, const Numbers& numbers) {
    const auto found = lines_.find(name);
    if (found == lines_.end()) numbers.fail();
    reached_->points[{found->second, without_line(name, found->second)}] += count;
  }
  void branch(int line, const std::vector<std::string>& words, const Numbers& numbers) {
    if (words.size() != 3 || numbers.count(words[1]) >= kWays.size()) numbers.fail();
    reached_->branches[{line, numbers.small(words[0]), static_cast<Way>(numbers.count(words[1]))}] +=
        numbers.count(words[2]);
  }

  Files& files_;
  Reached* reached_ = nullptr;
  std::map<std::string, int> lines_;  ///< of the points
};

}  // namespace

const char* name(Way way) { return kWays.at(static_cast<std::size_t>(way)); }

void add(Files& sum, const Files& more) {
  for (const auto& [path, reached] : more) {
    Reached& file = sum[path];
    add_counts(file.lines, reached.lines);
    add_counts(file.branches, reached.branches);
    add_counts(file.points, reached.points);
  }
}

Files of_verilator(const std::string& records, const std::string& origin) {
  Files files;
  int number = 0;
  for (const std::string& line : split(records, '\n')) {
    const Numbers numbers(origin, ++number, "a record of coverage as Verilator 5 writes it");
    if (line.rfind('#', 0) == 0) continue;
    const std::size_t end = line.rfind("' ");
    if (line.rfind("C '", 0) != 0 || end == std::string::npos || end < 3) numbers.fail();
    Fields fields = fields_of(line.substr(3, end - 3));
    add_record(files, fields, numbers.count(line.substr(end + 2)), numbers);
  }
  return files;
}

std::string lcov(const Files& files) {
  std::string text = "TN:\n";
  for (const auto& [path, reached] : files) text += lcov(path, reached);
  return text;
}

Files of_lcov(const std::string& text, const std::string& origin) {
  Files files;
  Reader reader(files);
  int number = 0;
  for (const std::string& line : split(text, '\n'))
    reader.line(line, Numbers(origin, ++number, "a tracefile of coverage as this program writes it"));
  return files;
}

}  // namespace dsdpv1::tb::coverage

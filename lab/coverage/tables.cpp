#include "lab/coverage/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "bus/printable.hpp"
#include "tb/report/markup.hpp"

namespace dsdpv1::tb::coverage {
namespace {

namespace fs = std::filesystem;

struct Share {
  std::size_t reached = 0, all = 0;

  void add(const Share& more) {
    reached += more.reached;
    all += more.all;
  }
  std::string percent() const {
    constexpr std::size_t kAll = 1000, kWhole = 10;
    const std::size_t share = all == 0 ? 0 : kAll * reached / all;  // rounded down: 100.0 is all
    return all == 0 ? "" : fmt::format("{}.{} %", share / kWhole, share % kWhole);
  }
};

struct Shares {
  Share lines, branches, points;

  void add(const Shares& more) {
    lines.add(more.lines);
    branches.add(more.branches);
    points.add(more.points);
  }
};

template <class Counts>
Share share_of(const Counts& counts) {
  return {reached_of(counts), counts.size()};
}

Shares shares_of(const Reached& file) { return {share_of(file.lines), share_of(file.branches), share_of(file.points)}; }

Shares shares_of(const Files& files) {
  Shares sum;
  for (const auto& each : files) sum.add(shares_of(each.second));
  return sum;
}

/// From this folder on, if it is in there.
std::string shown(const std::string& path) {
  const std::string near = fs::path(path).lexically_proximate(fs::current_path()).string();
  return near.rfind("..", 0) == 0 ? path : near;
}

// --- what is missing -------------------------------------------------------------------------------------------------

struct Missing {
  int line;
  std::string what;
};

/// "7:4, 2"; `bits` from the highest on.
std::string ranges(const std::vector<int>& bits) {
  std::string text;
  for (std::size_t i = 0; i < bits.size();) {
    std::size_t end = i + 1;
    while (end < bits.size() && bits[end] == bits[end - 1] - 1) ++end;
    text += (text.empty() ? "" : ", ") + std::to_string(bits[i]);
    if (end - i > 1) text += fmt::format(":{}", bits[end - 1]);
    i = end;
  }
  return text;
}

/// "data_q[3]" is a bit of data_q; one without a number is a whole signal.
int bit_of(const std::string& name) {
  const std::size_t open = name.rfind('['), digits = name.size() - std::min<std::size_t>(name.size(), open + 2);
  constexpr std::size_t kMostDigits = 6;
  if (open == std::string::npos || name.back() != ']' || digits == 0 || digits > kMostDigits) return -1;
  const std::string number = name.substr(open + 1, digits);
  return number.find_first_not_of("0123456789") == std::string::npos ? std::stoi(number) : -1;
}

void add_toggles(const Reached& file, std::vector<Missing>& missing) {
  std::map<Reached::Point, std::vector<int>> signals;
  for (const auto& [point, count] : file.points) {
    if (count != 0) continue;
    const int bit = bit_of(point.second);
    std::vector<int>& bits =
        signals[{point.first, bit < 0 ? point.second : point.second.substr(0, point.second.rfind('['))}];
    if (bit >= 0) bits.push_back(bit);
  }
  for (auto& [signal, bits] : signals) {
    std::sort(bits.rbegin(), bits.rend());
    missing.push_back({signal.first, "toggle " + signal.second + (bits.empty() ? "" : "[" + ranges(bits) + "]")});
  }
}

/// In the order of lines.
std::vector<Missing> missing_of(const Reached& file) {
  std::vector<Missing> missing;
  for (const auto& [line, count] : file.lines)
    if (count == 0) missing.push_back({line, "line"});
  for (const auto& [branch, count] : file.branches)
    if (count == 0)
      missing.push_back(
          {std::get<0>(branch), fmt::format("branch {} in column {}", name(std::get<2>(branch)), std::get<1>(branch))});
  add_toggles(file, missing);
  std::stable_sort(missing.begin(), missing.end(), [](const Missing& a, const Missing& b) { return a.line < b.line; });
  return missing;
}

// --- text ------------------------------------------------------------------------------------------------------------

std::string tsv_row(const std::string& file, const Shares& shares) {
  std::string text = bus::printable(file);
  for (const Share& each : {shares.lines, shares.branches, shares.points})
    text += fmt::format("\t{}\t{}", each.reached, each.all);
  return text + "\n";
}

std::string cells(const Shares& shares) {
  std::string text;
  for (const Share& each : {shares.lines, shares.branches, shares.points})
    text += fmt::format("<td>{} of {}</td><td>{}</td>", each.reached, each.all, each.percent());
  return text;
}

std::string escaped(const std::string& text) { return markup_escaped(bus::printable(text)); }

std::string html_row(const std::string& path, const Reached& file) {
  const std::string shown_path = escaped(shown(path));
  std::string text = "<tr><td>" + shown_path;
  const std::vector<Missing> missing = missing_of(file);
  if (!missing.empty()) text += "<details><summary>not reached</summary><pre>";
  for (const Missing& each : missing) text += fmt::format("{}:{}: {}\n", shown_path, each.line, escaped(each.what));
  if (!missing.empty()) text += "</pre></details>";
  return text + "</td>" + cells(shares_of(file)) + "</tr>\n";
}

}  // namespace

std::string summary(const Files& files) {
  const Shares sum = shares_of(files);
  return fmt::format("{} of {} lines, {} of {} branches, {} of {} toggles", sum.lines.reached, sum.lines.all,
                     sum.branches.reached, sum.branches.all, sum.points.reached, sum.points.all);
}

std::string tsv(const Files& files) {
  std::string text = "file\tlines reached\tlines\tbranches reached\tbranches\ttoggles reached\ttoggles\n";
  for (const auto& [path, file] : files) text += tsv_row(shown(path), shares_of(file));
  return text + tsv_row("all", shares_of(files));
}

std::string missing_tsv(const Files& files) {
  std::string text = "place\tnot reached\n";
  for (const auto& [path, file] : files)
    for (const Missing& each : missing_of(file))
      text += fmt::format("{}:{}\t{}\n", bus::printable(shown(path)), each.line, bus::printable(each.what));
  return text;
}

std::string html(const Files& files) {
  std::string text =
      "<h2>Reached of the RTL</h2>\n<table>\n<thead><tr><th scope=\"col\">file</th><th scope=\"col\" "
      "colspan=\"2\">lines</th><th scope=\"col\" colspan=\"2\">branches</th><th scope=\"col\" "
      "colspan=\"2\">toggles</th></tr></thead>\n<tbody>\n";
  for (const auto& [path, file] : files) text += html_row(path, file);
  return text + "<tr><td>all</td>" + cells(shares_of(files)) + "</tr>\n</tbody>\n</table>\n";
}

}  // namespace dsdpv1::tb::coverage

#include "lab/sweep/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "tb/report/text_table.hpp"

namespace dsdpv1::tb::sweep {
namespace {

using Row = std::vector<std::string>;

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string text = "\"";
  for (const char c : field) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

std::string csv_line(const Row& row) {
  std::string text;
  for (const std::string& field : row) text += (text.empty() ? "" : ",") + quoted(field);
  return text + "\n";
}

std::string margin_text(const CheckSeen* check) {
  return check != nullptr && check->margin_ns ? fmt::format("{:.3f}", *check->margin_ns) : "";
}

Row csv_head(const Plan& plan, const Row& checks) {
  Row row = {"point"};
  for (const Parameter& parameter : plan.parameters) row.push_back(parameter.path);
  for (const char* name : {"holds", "exit_code", "violations", "bad_reads", "worst_check", "worst_margin_ns",
                           "first_violation", "first_violation_at_ns", "reason"})
    row.emplace_back(name);
  for (const std::string& id : checks) {
    row.push_back(id + "_violations");
    row.push_back(id + "_margin_ns");
  }
  return row;
}

Row csv_row(const Point& point, const Row& checks) {
  const CheckSeen* worst = point.worst();
  Row row = {point.holds()      ? "yes"
             : point.possible() ? "no"
                                : "not possible",
             fmt::format("{}", point.exit),
             fmt::format("{}", point.violations),
             fmt::format("{}", point.bad_reads),
             worst != nullptr ? worst->id : "",
             margin_text(worst),
             point.first ? point.first->code : "",
             point.first ? fmt::format("{:.3f}", point.first->at_ns) : "",
             point.reason()};
  for (const std::string& id : checks) {
    const CheckSeen* check = point.check(id);
    row.push_back(check != nullptr ? fmt::format("{}", check->violations) : "");
    row.push_back(margin_text(check));
  }
  return row;
}

/// The points that differ in the first parameter only.
class Line {
 public:
  Line(const Plan& plan, const std::vector<Point>& points, std::size_t rest)
      : first_(plan.parameters.front()), points_(points), rest_(rest), lines_(points.size() / first_.values.size()) {}

  /// "0, 3..15", "all", "none": the values at which `is` is true.
  std::string values(const std::function<bool(const Point&)>& is) const {
    std::string text;
    std::size_t matches = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      if (!is(at(i))) continue;
      const std::size_t begin = i;
      while (i + 1 < size() && is(at(i + 1))) ++i;
      matches += i - begin + 1;
      text += (text.empty() ? "" : ", ") + run(begin, i);
    }
    if (matches == size()) return "all";
    return matches == 0 ? "none" : text;
  }

  /// The begin of the violation: a point that does not hold beside one that does, else the first that does not.
  std::optional<std::size_t> border() const {
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < size(); ++i) {
      if (at(i).holds()) continue;
      const bool beside = (i > 0 && at(i - 1).holds()) || (i + 1 < size() && at(i + 1).holds());
      if (beside) return i;
      if (!first) first = i;
    }
    return first;
  }

  std::string border_text() const {
    const std::optional<std::size_t> place = border();
    return place ? fmt::format("{}: {}", first_.values[*place], at(*place).reason()) : "";
  }

 private:
  std::size_t size() const { return first_.values.size(); }
  const Point& at(std::size_t i) const { return points_[i * lines_ + rest_]; }
  std::string run(std::size_t begin, std::size_t end) const {
    const std::string& from = first_.values[begin];
    if (begin == end) return from;
    return from + (end == begin + 1 ? ", " : "..") + first_.values[end];
  }

  const Parameter& first_;
  const std::vector<Point>& points_;
  std::size_t rest_, lines_;
};

std::string line_table(const Plan& plan, const std::vector<Point>& points) {
  const std::string first = plan.short_name(0);
  Row head;
  for (std::size_t i = 1; i < plan.parameters.size(); ++i) head.push_back(plan.short_name(i));
  for (const std::string& name : {first + " where it holds", first + " where not", first + ": first violation"})
    head.push_back(name);
  TextTable table(head);
  for (std::size_t rest = 0; rest < points.size() / plan.parameters.front().values.size(); ++rest) {
    const Line line(plan, points, rest);
    Row row = plan.values(rest);
    row.erase(row.begin());
    row.push_back(line.values([](const Point& point) { return point.holds(); }));
    row.push_back(line.values([](const Point& point) { return !point.holds(); }));
    row.push_back(line.border_text());
    table.add(row);
  }
  return table.text();
}

std::string place(const Plan& plan, std::size_t point) {
  const Row values = plan.values(point);
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i)
    text += (text.empty() ? "" : ", ") + plan.short_name(i) + "=" + values[i];
  return text;
}

/// The least margin among the points that hold.
std::string least_margin(const Plan& plan, const std::vector<Point>& points) {
  std::optional<std::size_t> least;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].holds() || points[i].worst() == nullptr) continue;
    if (!least || *points[i].worst()->margin_ns < *points[*least].worst()->margin_ns) least = i;
  }
  if (!least) return "";
  const CheckSeen* worst = points[*least].worst();
  return fmt::format("  least margin where it holds: {:.3f} ns ({}) at {}\n", *worst->margin_ns, worst->id,
                     place(plan, *least));
}

}  // namespace

std::vector<std::string> check_ids(const std::vector<Point>& points) {
  std::vector<std::string> ids;
  for (const Point& point : points) {
    for (const CheckSeen& check : point.checks)
      if (std::find(ids.begin(), ids.end(), check.id) == ids.end()) ids.push_back(check.id);
  }
  return ids;
}

std::string csv(const Plan& plan, const std::vector<Point>& points) {
  const Row checks = check_ids(points);
  std::string text = csv_line(csv_head(plan, checks));
  for (std::size_t i = 0; i < points.size(); ++i) {
    Row row = {fmt::format("{}", i)};
    for (const Row& part : {plan.values(i), csv_row(points[i], checks)})
      row.insert(row.end(), part.begin(), part.end());
    text += csv_line(row);
  }
  return text;
}

std::string summary(const Plan& plan, const std::vector<Point>& points) {
  const auto count = [&points](bool (*is)(const Point&)) { return std::count_if(points.begin(), points.end(), is); };
  const auto holding = count([](const Point& point) { return point.holds(); });
  const auto impossible = count([](const Point& point) { return !point.possible(); });
  std::string text = "\n" + line_table(plan, points);
  text += fmt::format("\n  the timing holds at {} of {} points", holding, points.size());
  if (impossible != 0) text += fmt::format(", {} are not possible", impossible);
  return text + "\n" + least_margin(plan, points);
}

}  // namespace dsdpv1::tb::sweep

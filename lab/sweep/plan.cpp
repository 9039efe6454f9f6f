#include "lab/sweep/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>

#include "io/input/input_error.hpp"
#include "io/input/units.hpp"
#include "tb/scenario/settings.hpp"

namespace dsdpv1::tb::sweep {
namespace {

using keys::Kind;

constexpr std::size_t kMostValues = 10'000, kMostPoints = 100'000;

[[noreturn]] void fail(const std::string& origin, const std::string& text) { throw InputError(origin, 0, text); }

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

struct Bounds {
  std::int64_t first = 0, last = 0, step = 1;
};

std::optional<std::int64_t> parse(Kind kind, const std::string& text) {
  return kind == Kind::kTime ? parse_time(text) : parse_integer(text);
}

/// "a..b" or "a..b/step", in whole numbers or ticks.
Bounds parse_range(Kind kind, const std::string& text, const std::string& origin) {
  const char* const allowed =
      kind == Kind::kTime ? "FIRST..LAST/STEP in times, like 10ns..100ns/10ns" : "FIRST..LAST or FIRST..LAST/STEP";
  const std::size_t dots = text.find(".."), slash = text.find('/', dots);
  const std::size_t length = slash == std::string::npos ? slash : slash - dots - 2;
  const auto first = parse(kind, text.substr(0, dots)), last = parse(kind, text.substr(dots + 2, length));
  std::optional<std::int64_t> step;
  if (slash != std::string::npos)
    step = parse(kind, text.substr(slash + 1));
  else if (kind == Kind::kInteger)
    step = 1;
  if (!first || !last || !step) fail(origin, fmt::format("range {} is not understood, expected {}", text, allowed));
  if (*last < *first) fail(origin, fmt::format("range {} ends before it begins", text));
  if (*step <= 0) fail(origin, fmt::format("range {} has no step forward, expected a step above 0", text));
  return {*first, *last, *step};
}

std::vector<std::string> expand(Kind kind, const std::string& text, const std::string& origin) {
  const bool ranges = kind == Kind::kInteger || kind == Kind::kTime;
  if (!ranges || text.find("..") == std::string::npos) return {text};
  const Bounds bounds = parse_range(kind, text, origin);
  if ((bounds.last - bounds.first) / bounds.step >= static_cast<std::int64_t>(kMostValues))
    fail(origin, fmt::format("range {} has more than {} values", text, kMostValues));
  std::vector<std::string> values;
  for (std::int64_t value = bounds.first; value <= bounds.last; value += bounds.step)
    values.push_back(kind == Kind::kTime ? time_text(value) : std::to_string(value));
  return values;
}

std::string path_of(const std::string& setting) { return setting.substr(0, setting.find('=')); }

std::string last_step(const std::string& path) { return path.substr(path.rfind('.') + 1); }

}  // namespace

std::vector<std::string> values_of(Kind kind, const std::string& list, const std::string& origin) {
  std::vector<std::string> values;
  std::set<std::string> seen;
  for (const std::string& item : split(list, ',')) {
    for (const std::string& value : expand(kind, item, origin)) {
      if (!seen.insert(value).second) fail(origin, fmt::format("{} is there twice, expected once", value));
      values.push_back(value);
    }
  }
  if (values.size() > kMostValues)
    fail(origin, fmt::format("{} values, expected at most {}", values.size(), kMostValues));
  return values;
}

Parameter parse_parameter(const std::string& text, const std::string& option) {
  const scenario::Setting given = scenario::parse_setting(option, text);
  const Kind kind = scenario::field_of_any(given.path, given.origin).type.kind;
  Parameter parameter{given.path, values_of(kind, given.value, given.origin)};
  for (const std::string& value : parameter.values) scenario::check({given.path, value, given.origin});
  return parameter;
}

std::size_t Plan::points() const {
  std::size_t points = 1;
  for (const Parameter& parameter : parameters) points *= parameter.values.size();
  return points;
}

std::vector<std::string> Plan::values(std::size_t point) const {
  std::vector<std::string> values(parameters.size());
  for (std::size_t i = parameters.size(); i-- > 0;) {
    const std::vector<std::string>& all = parameters[i].values;
    values[i] = all[point % all.size()];
    point /= all.size();
  }
  return values;
}

std::vector<std::string> Plan::settings_of(std::size_t point) const {
  std::vector<std::string> all = settings;
  const std::vector<std::string> swept = values(point);
  for (std::size_t i = 0; i < parameters.size(); ++i) all.push_back(parameters[i].path + "=" + swept[i]);
  return all;
}

std::string Plan::short_name(std::size_t parameter) const {
  const std::string name = last_step(parameters[parameter].path);
  const auto same = std::count_if(parameters.begin(), parameters.end(),
                                  [&name](const Parameter& each) { return last_step(each.path) == name; });
  return same == 1 ? name : parameters[parameter].path;
}

void check(const Plan& plan) {
  if (plan.parameters.empty())
    throw InputError(
        "dsdpv1-sim sweep: --param is missing, expected something like --param user_cpu.fsmc.datast=0..15");
  std::set<std::string> paths;
  const auto take = [&paths](const std::string& option, const std::string& path) {
    if (!paths.insert(path).second) fail(option + " " + path, "is set twice, expected once");
  };
  for (const std::string& setting : plan.settings) take("--set", path_of(setting));
  std::size_t points = 1;
  for (const Parameter& parameter : plan.parameters) {
    take("--param", parameter.path);
    points *= parameter.values.size();
    if (points > kMostPoints)
      throw InputError(
          fmt::format("dsdpv1-sim sweep: more than {} points, expected fewer values or parameters", kMostPoints));
  }
}

}  // namespace dsdpv1::tb::sweep

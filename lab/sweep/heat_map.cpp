#include "lab/sweep/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <utility>

#include "tb/report/markup.hpp"

namespace dsdpv1::tb::sweep {
namespace {

struct Colour {
  int red, green, blue;
};

// All kinds of colour vision can tell blue from orange. Light: little margin or a small violation; dark: much.
constexpr Colour kHoldsLeast = {222, 235, 247}, kHoldsMost = {66, 146, 198};
constexpr Colour kFailsLeast = {253, 208, 162}, kFailsMost = {230, 85, 13};
constexpr int kHeight = 34, kTop = 90, kLegend = 74;
constexpr double kWithoutMargin = 0.6;  // darkness of a cell without a margin
constexpr double kTextWidth = 34;       // narrower cells have no number

Colour between(const Colour& a, const Colour& b, double part) {
  const auto mix = [part](int from, int to) { return from + static_cast<int>(std::lround((to - from) * part)); };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

std::string hex(const Colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour.red, colour.green, colour.blue);
}

std::string text_at(double x, double y, const std::string& style, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, style, markup_escaped(text));
}

std::string number(double ns) {
  return std::abs(ns) < 999.5 ? fmt::format("{:.1f}", ns) : fmt::format("{:.3g}u", ns / 1000);
}

constexpr const char* kHead =
    R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0:.0f}" height="{1:.0f}" viewBox="0 0 {0:.0f} {1:.0f}"
  font-family="sans-serif" font-size="12">
<defs><pattern id="hatch" width="6" height="6" patternUnits="userSpaceOnUse">
<rect width="6" height="6" fill="#e0e0e0"/>
<path d="M0 6L6 0" stroke="#909090"/></pattern></defs>
<rect width="100%" height="100%" fill="white"/>
)";

/// Margins over all pictures, so that their colours mean the same.
struct Scale {
  double most = 0, deepest = 0;  ///< greatest margin where it holds, greatest violation, both in ns and not negative

  Scale(const std::vector<Point>& points, std::string check) : check_(std::move(check)) {
    for (const Point& point : points) {
      const CheckSeen* worst = shown(point);
      if (worst == nullptr) continue;
      (point.holds() ? most : deepest) =
          std::max(point.holds() ? most : deepest, point.holds() ? *worst->margin_ns : -*worst->margin_ns);
    }
  }

  /// The check whose margin a cell shows.
  const CheckSeen* shown(const Point& point) const {
    const CheckSeen* check = check_.empty() ? point.worst() : point.check(check_);
    return check != nullptr && check->margin_ns ? check : nullptr;
  }

  std::string subject() const {
    if (most == 0 && deepest == 0) return "";
    return ": " + (check_.empty() ? "worst margin" : "margin of " + check_) + " / ns";
  }

  Colour colour(const Point& point) const {
    const CheckSeen* worst = shown(point);
    const double margin = worst != nullptr ? *worst->margin_ns : 0;
    if (point.holds()) return between(kHoldsLeast, kHoldsMost, part(margin, most));
    return between(kFailsLeast, kFailsMost, part(-margin, deepest));
  }

  /// The text of a cell: the margin if it is meaningful.
  std::string text(const Point& point) const {
    if (!point.possible()) return "";
    const CheckSeen* worst = shown(point);
    const bool telling = worst != nullptr && (point.holds() || *worst->margin_ns < 0);
    if (telling) return number(*worst->margin_ns);
    return point.holds() ? "holds" : "fails";
  }

 private:
  static double part(double value, double greatest) {
    return greatest > 0 ? std::clamp(value / greatest, 0.0, 1.0) : kWithoutMargin;
  }

  std::string check_;
};

/// One picture: the points whose other parameters have their `other`-th combination of values.
class Map {
 public:
  Map(const Plan& plan, const std::vector<Point>& points, const Scale& scale, std::size_t other)
      : plan_(plan),
        points_(points),
        scale_(scale),
        other_(other),
        columns_(plan.parameters[0].values.size()),
        rows_(plan.parameters.size() > 1 ? plan.parameters[1].values.size() : 1),
        others_(points.size() / columns_ / rows_),
        cell_(std::clamp(960.0 / static_cast<double>(columns_), 4.0, 60.0)),
        left_(label_width()) {}

  std::string svg() const {
    const double width = std::max(left_ + cell_ * static_cast<double>(columns_) + 24, 720.0);
    const double height = bottom() + kLegend;
    return fmt::format(kHead, width, height) + head() + axes() + cells() + borders() + legend() + "</svg>\n";
  }

 private:
  const Point& at(std::size_t column, std::size_t row) const {
    return points_[(column * rows_ + row) * others_ + other_];
  }
  double x(std::size_t column) const { return left_ + cell_ * static_cast<double>(column); }
  static double y(std::size_t row) { return kTop + kHeight * static_cast<double>(row); }
  double bottom() const { return y(rows_) + 12; }

  /// Width for the values of the second parameter.
  double label_width() const {
    if (plan_.parameters.size() < 2) return 24;
    std::size_t longest = plan_.short_name(1).size();
    for (const std::string& value : plan_.parameters[1].values) longest = std::max(longest, value.size());
    return 24 + 7.5 * static_cast<double>(longest);
  }

  std::string head() const {
    std::string what = std::filesystem::path(plan_.scenario).filename().string();
    const std::vector<std::string> values = plan_.values(other_);
    for (std::size_t i = 2; i < values.size(); ++i) what += fmt::format("  {}={}", plan_.parameters[i].path, values[i]);
    for (const std::string& setting : plan_.settings) what += "  " + setting;
    return text_at(12, 22, R"(font-size="15" font-weight="bold")", "Where the timing holds" + scale_.subject()) +
           text_at(12, 40, "fill=\"#505050\"", what);
  }

  std::string axes() const {
    const char* const middle = "text-anchor=\"middle\"";
    std::string text = text_at(left_, kTop - 22, "font-weight=\"bold\"", plan_.parameters[0].path);
    const auto& names = plan_.parameters[0].values;
    std::size_t longest = 0;
    for (const std::string& name : names) longest = std::max(longest, name.size());
    const auto every = static_cast<std::size_t>(std::ceil((7.5 * static_cast<double>(longest) + 4) / cell_));
    for (std::size_t i = 0; i < columns_; i += every) text += text_at(x(i) + cell_ / 2, kTop - 6, middle, names[i]);
    if (plan_.parameters.size() < 2) return text;
    text += text_at(12, kTop - 6, "font-weight=\"bold\"", plan_.short_name(1));
    for (std::size_t i = 0; i < rows_; ++i)
      text += text_at(left_ - 8, y(i) + kHeight / 2.0 + 4, "text-anchor=\"end\"", plan_.parameters[1].values[i]);
    return text;
  }

  std::string cells() const {
    std::string text;
    for (std::size_t row = 0; row < rows_; ++row)
      for (std::size_t column = 0; column < columns_; ++column) text += cell(column, row);
    return text;
  }

  std::string cell(std::size_t column, std::size_t row) const {
    const Point& point = at(column, row);
    const std::string fill = point.possible() ? hex(scale_.colour(point)) : "url(#hatch)";
    std::string text = fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\" fill=\"{}\" "
        "stroke=\"white\"><title>{}</title></rect>\n",
        x(column), y(row), cell_, kHeight, fill, markup_escaped(title(column, row)));
    if (cell_ >= kTextWidth)
      text += text_at(x(column) + cell_ / 2, y(row) + kHeight / 2.0 + 4, "text-anchor=\"middle\"", scale_.text(point));
    return text;
  }

  /// Shown while the mouse is on a cell.
  std::string title(std::size_t column, std::size_t row) const {
    const Point& point = at(column, row);
    std::string text = plan_.short_name(0) + "=" + plan_.parameters[0].values[column];
    if (plan_.parameters.size() > 1) text += ", " + plan_.short_name(1) + "=" + plan_.parameters[1].values[row];
    if (const CheckSeen* check = scale_.shown(point))
      text += fmt::format(": {:.3f} ns ({})", *check->margin_ns, check->id);
    return text + (point.holds() ? "" : ": " + point.reason());
  }

  /// A line between points that hold and points that do not.
  std::string borders() const {
    std::string path;
    for (std::size_t row = 0; row < rows_; ++row) {
      for (std::size_t column = 0; column < columns_; ++column) {
        const bool holds = at(column, row).holds();
        if (column + 1 < columns_ && at(column + 1, row).holds() != holds)
          path += fmt::format("M{:.1f} {:.1f}v{}", x(column + 1), y(row), kHeight);
        if (row + 1 < rows_ && at(column, row + 1).holds() != holds)
          path += fmt::format("M{:.1f} {:.1f}h{:.1f}", x(column), y(row + 1), cell_);
      }
    }
    return path.empty() ? ""
                        : fmt::format("<path d=\"{}\" stroke=\"black\" stroke-width=\"3\" fill=\"none\"/>\n", path);
  }

  std::string legend() const {
    struct Entry {
      std::string fill, text;
    };
    const std::string most = scale_.most > 0 ? " (dark: " + number(scale_.most) + " ns)" : "";
    const std::string deepest = scale_.deepest > 0 ? " (dark: " + number(-scale_.deepest) + " ns)" : "";
    const std::array<Entry, 3> entries = {
        {{hex(between(kHoldsLeast, kHoldsMost, kWithoutMargin)), "holds" + most},
         {hex(between(kFailsLeast, kFailsMost, kWithoutMargin)), "does not hold" + deepest},
         {"url(#hatch)", "not possible"}}};
    std::string text;
    double place = 12;
    for (const Entry& entry : entries) {
      text += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"16\" height=\"16\" fill=\"{}\"/>\n", place,
                          bottom() + 8, entry.fill);
      text += text_at(place + 22, bottom() + 20, "", entry.text);
      place += 54 + 6.6 * static_cast<double>(entry.text.size());
    }
    text += fmt::format("<path d=\"M{:.1f} {:.1f}v16\" stroke=\"black\" stroke-width=\"3\"/>\n", place, bottom() + 8);
    text += text_at(place + 10, bottom() + 20, "", "where violations begin");
    return text + text_at(12, bottom() + 46, "fill=\"#505050\"", first_violation());
  }

  /// The reason in words, for the first point at the border.
  std::string first_violation() const {
    for (std::size_t row = 0; row < rows_; ++row) {
      for (std::size_t column = 0; column < columns_; ++column) {
        const bool beside =
            (column > 0 && at(column - 1, row).holds()) || (column + 1 < columns_ && at(column + 1, row).holds());
        if (!at(column, row).holds() && (beside || columns_ == 1)) return shortened(title(column, row));
      }
    }
    return "";
  }

  static std::string shortened(const std::string& text) {
    return text.size() > 130 ? text.substr(0, 127) + "..." : text;
  }

  const Plan& plan_;
  const std::vector<Point>& points_;
  const Scale& scale_;
  std::size_t other_, columns_, rows_, others_;
  double cell_, left_;
};

}  // namespace

std::vector<Picture> heat_maps(const Plan& plan, const std::vector<Point>& points, const std::string& check) {
  const Scale scale(points, check);
  const std::size_t shown =
      plan.parameters[0].values.size() * (plan.parameters.size() > 1 ? plan.parameters[1].values.size() : 1);
  const std::size_t others = points.size() / shown;
  std::vector<Picture> pictures;
  for (std::size_t other = 0; other < others; ++other) {
    const std::string name = others == 1 ? "map.svg" : fmt::format("map_{}.svg", other + 1);
    pictures.push_back({name, Map(plan, points, scale, other).svg()});
  }
  return pictures;
}

}  // namespace dsdpv1::tb::sweep

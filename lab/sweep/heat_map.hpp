#pragma once
// Pictures of a sweep (SVG): a cell a point, coloured by its worst margin.
#include <string>
#include <vector>

#include "lab/sweep/plan.hpp"
#include "lab/sweep/point.hpp"

namespace dsdpv1::tb::sweep {

struct Picture {
  std::string name;  ///< "map.svg"; of several "map_1.svg", ...
  std::string svg;
};

/// Cells show the margin of `check`, or when that is empty the worst of all checks. The first parameter runs to the
/// right, the second downwards; with three and more parameters there is a picture for each combination of the others.
std::vector<Picture> heat_maps(const Plan& plan, const std::vector<Point>& points, const std::string& check = "");

}  // namespace dsdpv1::tb::sweep

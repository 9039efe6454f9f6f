#pragma once
// The activity at a chip's pins before a difference: on its line, at its memory. The chip's kind defines the pins and
// their meaning.
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lab/compare/scale.hpp"

namespace dsdpv1::tb::compare {

/// A heading and a text, for a line of the report.
using Line = std::pair<std::string, std::string>;

class Surroundings {
 public:
  virtual ~Surroundings() = default;
  /// Names of the observed pins.
  virtual const std::vector<std::string>& pins() const = 0;
  /// A pin (its place in `pins`) has a new value, bits as WaveEvent has them; in order of time.
  virtual void change(bus::Tick at, std::size_t pin, std::string_view value) = 0;
  /// The report up to `now`, which is not before the last change.
  virtual std::vector<Line> lines(bus::Tick now) const = 0;
};

class Nets;
/// For the signals of A.
using MakeSurroundings = std::function<std::unique_ptr<Surroundings>(const Nets& a)>;

}  // namespace dsdpv1::tb::compare

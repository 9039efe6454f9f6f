#include "lab/calibrate/estimate.hpp"

#include <cmath>
#include <iterator>

namespace dsdpv1::calibrate {
namespace {

constexpr double kSigmas = 5;

/// The span is empty.
bool is_empty(const Instance& instance) { return instance.span.lo > instance.span.hi; }

struct End {
  double at;
  bool closes;
};

/// The place at which most spans overlap, the first of several.
Span deepest(const std::vector<Instance>& instances) {
  std::vector<End> ends;
  for (const Instance& instance : instances) {
    ends.push_back({instance.span.lo, false});
    ends.push_back({instance.span.hi, true});
  }
  std::sort(ends.begin(), ends.end(),
            [](const End& a, const End& b) { return a.at != b.at ? a.at < b.at : a.closes < b.closes; });
  std::size_t depth = 0, most = 0;
  Span best;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i].closes) {
      --depth;
      continue;
    }
    if (++depth <= most) continue;
    most = depth;
    best = {ends[i].at, ends[i + 1].at};  // the next end closes, or goes deeper and replaces this
  }
  return best;
}

/// Least number of samples by which the chip's clock drifts past the analyser's.
double drift(const Instance& first, const Instance& last, const TimeBase& time) {
  const double off = time.scale.contains(1) ? 0 : std::min(std::abs(time.scale.lo - 1), std::abs(time.scale.hi - 1));
  return off * TimeBase::nominal(last.at - first.at) / time.period;
}

/// The mean of the agreeing instances, with its error.
std::optional<Span> mean(const std::vector<Instance>& instances, const Span& agreed, const TimeBase& time) {
  double sum = 0, squares = 0, count = 0;
  const Instance *first = nullptr, *last = nullptr;
  for (const Instance& instance : instances) {
    if (!overlap(instance.span, agreed)) continue;
    if (first == nullptr || instance.at < first->at) first = &instance;
    if (last == nullptr || instance.at > last->at) last = &instance;
    sum += instance.best, squares += instance.best * instance.best, ++count;
  }
  const double drifted = count > 1 ? drift(*first, *last, time) : 0;
  if (drifted < 1) return std::nullopt;
  const double middle = sum / count, variance = std::max(squares / count - middle * middle, 0.0);
  const double chance = kSigmas * std::sqrt(variance / count + time.period * time.period / (count * count));
  const double off = time.jitter + chance + time.period / (2 * drifted);
  return Span{middle - off, middle + off};
}

}  // namespace

std::optional<long long> Estimate::whole() const {
  const long long low = std::llround(std::ceil(span.lo));
  if (count == 0 || static_cast<double>(low) > span.hi || static_cast<double>(low + 1) <= span.hi) return std::nullopt;
  return low;
}

Estimate estimate(const std::vector<Instance>& instances, const TimeBase* time) {
  if (std::any_of(instances.begin(), instances.end(), is_empty)) {
    std::vector<Instance> others;
    std::remove_copy_if(instances.begin(), instances.end(), std::back_inserter(others), is_empty);
    return estimate(others, time);
  }
  Estimate result;
  result.count = instances.size();
  if (instances.empty()) return result;
  result.span = deepest(instances);
  for (const Instance& instance : instances) {
    if (overlap(instance.span, result.span)) continue;
    const bool below = instance.span.hi < result.span.lo;
    result.outliers.push_back(
        {instance.at, below ? instance.span.hi - result.span.lo : instance.span.lo - result.span.hi});
  }
  std::sort(result.outliers.begin(), result.outliers.end(),
            [](const Outlier& a, const Outlier& b) { return std::abs(a.by) > std::abs(b.by); });
  if (time == nullptr || time->period <= 0) return result;
  const std::optional<Span> by_mean = mean(instances, result.span, *time);
  if (!by_mean || !overlap(*by_mean, result.span) || by_mean->width() >= result.span.width()) return result;
  result.span = common(*by_mean, result.span);
  result.by_mean = true;
  return result;
}

}  // namespace dsdpv1::calibrate

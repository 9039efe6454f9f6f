#include "tb/report/html/diagram_watch.hpp"

#include <algorithm>

namespace dsdpv1::tb::html {
namespace {

constexpr std::size_t kMostOpen = 64;
constexpr Tick kLeastBeside = 20 * bus::kTicksPerNs;  ///< shown before and after an instance

Tick beside(const Instance& instance) { return std::max(kLeastBeside, (instance.last() - instance.first()) / 4); }

/// The better of two times, each of which may be missing.
template <class Better>
std::optional<Tick> better(std::optional<Tick> a, std::optional<Tick> b, const Better& is_better) {
  if (!a || !b) return a ? a : b;
  return is_better(*a, *b) ? a : b;
}

}  // namespace

std::optional<Tick> MeasuredSpan::margin() const {
  if (!seen()) return std::nullopt;
  std::optional<Tick> least, greatest;
  if (limits.least) least = measured() - *limits.least;
  if (limits.greatest) greatest = *limits.greatest - measured();
  return better(least, greatest, std::less<>());
}

std::optional<Tick> Instance::margin() const {
  std::optional<Tick> least;
  for (const MeasuredSpan& span : spans) least = better(least, span.margin(), std::less<>());
  return least;
}

Tick Instance::first() const {
  Tick first = anchor;
  for (const MeasuredSpan& span : spans)
    if (span.seen()) first = std::min(first, *span.from);
  return first;
}

Tick Instance::last() const {
  Tick last = anchor;
  for (const MeasuredSpan& span : spans)
    if (span.seen()) last = std::max(last, *span.to);
  return last;
}

/// Judges the oldest open ones as long as they are `done`.
template <class Done>
void DiagramWatch::close(const Done& done) {
  while (!open_.empty() && done(open_.front())) {
    judge(open_.front());
    open_.pop_front();
  }
}

void DiagramWatch::pin(Tick at, PinNumber pin, Level level) {
  if (candidate_ && at > candidate_->last() + beside(*candidate_)) take_picture();
  close([&](const Instance& each) { return at > each.anchor + diagram_.patience; });
  for (Instance& each : open_) resolve_later(each, at, pin, level);
  close([&](const Instance& each) { return is_complete(each); });
  const auto is_this = [&](const DiagramEdge& edge) { return memory_.is(edge, at, pin, level); };
  if (anchored_ != at && std::any_of(diagram_.anchors.begin(), diagram_.anchors.end(), is_this)) anchored(at);
}

void DiagramWatch::anchored(Tick at) {
  anchored_ = at;
  Instance instance{at, {}};
  for (std::size_t i = 0; i < diagram_.spans.size(); ++i) {
    const DiagramSpan& span = diagram_.spans[i];
    instance.spans.push_back({resolved(span.from, at, {}), resolved(span.to, at, {}), limits_[i]});
  }
  ++instances_;
  if (is_complete(instance)) {
    judge(instance);
    return;
  }
  if (open_.size() < kMostOpen) open_.push_back(std::move(instance));
}

void DiagramWatch::answered(Tick request_end, Tick answer_start, const SpanLimits& tsdr) {
  if (!diagram_.anchors.empty()) return;
  Instance instance{answer_start, {}};
  for (const DiagramSpan& span : diagram_.spans)
    instance.spans.push_back({resolved(span.from, answer_start, request_end),
                              resolved(span.to, answer_start, request_end), span.tsdr ? tsdr : SpanLimits()});
  ++instances_;
  judge(instance);
}

std::optional<Tick> DiagramWatch::resolved(const Moment& moment, Tick anchor, std::optional<Tick> request_end) const {
  switch (moment.of) {
    case Moment::Of::kAnchor: return anchor;
    case Moment::Of::kRequestEnded: return request_end;
    case Moment::Of::kReadSample: return sample_ && *sample_ <= anchor ? sample_ : anchor;
    case Moment::Of::kAfter: return std::nullopt;
    case Moment::Of::kBefore:
    case Moment::Of::kSince: break;
  }
  if (moment.begun.empty()) return last_of(moment.edges, anchor);
  const std::optional<Tick> begun = last_of(moment.begun, anchor);
  if (!begun) return std::nullopt;
  if (moment.of == Moment::Of::kSince) return first_of(moment.edges, *begun, anchor);
  return last_of(moment.edges, std::min(anchor, moment.until(*begun)));
}

std::optional<Tick> DiagramWatch::last_of(const std::vector<DiagramEdge>& edges, Tick until) const {
  std::optional<Tick> last;
  for (const DiagramEdge& edge : edges) last = better(last, memory_.last(edge, until), std::greater<>());
  return last;
}

std::optional<Tick> DiagramWatch::first_of(const std::vector<DiagramEdge>& edges, Tick from, Tick to) const {
  std::optional<Tick> first;
  for (const DiagramEdge& edge : edges) first = better(first, memory_.first(edge, from, to), std::less<>());
  return first;
}

void DiagramWatch::resolve_later(Instance& instance, Tick at, PinNumber pin, Level level) const {
  const auto look = [&](const Moment& moment, std::optional<Tick>& time) {
    if (time || moment.of != Moment::Of::kAfter) return;
    for (const DiagramEdge& edge : moment.edges)
      if (memory_.is(edge, at, pin, level)) time = at;
  };
  for (std::size_t i = 0; i < instance.spans.size(); ++i) {
    look(diagram_.spans[i].from, instance.spans[i].from);
    look(diagram_.spans[i].to, instance.spans[i].to);
  }
}

bool DiagramWatch::is_complete(const Instance& instance) const {
  for (std::size_t i = 0; i < instance.spans.size(); ++i) {
    const MeasuredSpan& span = instance.spans[i];
    if ((diagram_.spans[i].from.of == Moment::Of::kAfter && !span.from) ||
        (diagram_.spans[i].to.of == Moment::Of::kAfter && !span.to))
      return false;
  }
  return true;
}

void DiagramWatch::judge(const Instance& instance) {
  if (!is_worse(instance)) return;
  if (candidate_) take_picture();
  candidate_ = instance;
}

/// Less margin than all before, or the same within a shorter time, which shows it larger; where nothing is limited, the
/// longest.
bool DiagramWatch::is_worse(const Instance& instance) const {
  const Instance* const before = candidate_ ? &*candidate_ : worst_ ? &worst_->instance : nullptr;
  const std::optional<Tick> margin = instance.margin();
  if (before == nullptr) return true;
  const Tick longer = (instance.last() - instance.first()) - (before->last() - before->first());
  if (!margin || !before->margin()) return margin || (!before->margin() && longer > 0);
  return *margin < *before->margin() || (*margin == *before->margin() && longer < 0);
}

void DiagramWatch::take_picture() {
  DiagramPicture picture{*candidate_, 0, 0, {}};
  picture.from = candidate_->first() - beside(*candidate_);
  picture.to = candidate_->last() + beside(*candidate_);
  for (const PinNumber pin : diagram_.pins) picture.pins.push_back(memory_.trace(pin, picture.from, picture.to));
  worst_ = std::move(picture);
  candidate_.reset();
}

void DiagramWatch::finish() {
  for (const Instance& each : open_) judge(each);
  open_.clear();
  if (candidate_) take_picture();
}

}  // namespace dsdpv1::tb::html

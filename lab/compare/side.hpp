#pragma once
// One of the two waves during a comparison: the present values of its used signals.
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/waves/wave_reader.hpp"
#include "lab/compare/nets.hpp"
#include "lab/compare/pairs.hpp"

namespace dsdpv1::tb::compare {

/// Collects the indices that have changed since the last check.
class Touched {
 public:
  explicit Touched(std::size_t count) : is_(count, 0) {}
  void add(std::uint32_t which) {
    if (is_[which] != 0) return;
    is_[which] = 1;
    list_.push_back(which);
  }
  void add_all() {
    list_.resize(is_.size());
    std::iota(list_.begin(), list_.end(), 0U);
    is_.assign(is_.size(), 1);
  }
  const std::vector<std::uint32_t>& list() const { return list_; }
  void clear() {
    for (const std::uint32_t which : list_) is_[which] = 0;
    list_.clear();
  }

 private:
  std::vector<std::uint8_t> is_;
  std::vector<std::uint32_t> list_;
};

/// A source in the form that its side reads: indices of its values.
struct Probe {
  std::vector<std::uint32_t> pieces, driven, released;
  std::uint32_t width = 1;
  bool inverted = false, driven_low = false;
};

class Side {
 public:
  /// Throws InputError, like all reading functions here.
  Side(const std::string& path, const std::string& scope);

  const std::string& path() const { return path_; }
  const std::string& scope() const { return scope_; }
  const Nets& nets() const { return nets_; }
  int exponent() const { return reader_->declarations().exponent; }

  // Before `start`.
  /// Each change of the source adds `which` to `list`.
  Probe watch(const Source& source, Touched& list, std::uint32_t which);
  /// Reads up to the first event. Times are those of `scale`, `shift` later than in the file.
  void start(const Scale& scale, Time shift);

  /// The next event's; nullopt at the end of the file.
  std::optional<Time> next() const { return have_ ? std::optional(next_) : std::nullopt; }
  /// All events up to and including `to`.
  void advance(Time to) {
    while (have_ && next_ <= to) take();
  }
  /// Counts the moments of events from here on: their values are the counts.
  void restart_events();
  /// Until the next call.
  std::string_view value(const Probe& probe);
  /// True when the simulator records nothing ($dumpoff).
  bool off() const { return off_; }

  Time begin() const { return at(reader_->begin()); }
  Time end() const { return at(reader_->end()); }  ///< of the part read
  double share() const { return reader_->share(); }

 private:
  struct User {
    Touched* list;
    std::uint32_t which;
  };
  std::vector<std::uint32_t> places(const Net& net, Touched& list, std::uint32_t which);
  void take();
  void set(std::uint32_t place, std::string_view value);
  void fetch();
  Time at(std::uint64_t time) const;
  void put_together(const std::vector<std::uint32_t>& pieces);

  std::string path_, scope_;
  std::unique_ptr<WaveReader> reader_;
  Nets nets_;
  std::vector<std::uint32_t> place_;  ///< by signal of the file; kNone: not used
  std::vector<std::string> values_;   ///< by place
  std::vector<std::vector<User>> users_;
  std::vector<std::uint64_t> moments_;  ///< of events
  std::string scratch_;
  Scale scale_{-15};
  Time shift_ = 0, next_ = 0;
  WaveEvent event_;
  bool have_ = false, off_ = false;
};

}  // namespace dsdpv1::tb::compare

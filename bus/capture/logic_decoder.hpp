#pragma once
// Decodes telegrams from the levels of the line, as recorded by a logic analyser or a simulator.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/capture/captured_telegram.hpp"

namespace dsdpv1::bus::capture {

struct LogicSettings {
  std::optional<int> baud = {};  ///< index of the table in bus/baud.hpp; absent: detect the rate
  bool inverted = false;         ///< idle is low
  std::string signal = {};       ///< the line among several signals; empty: see choose_signal
  /// Called for each change of the line, idle high; may be null.
  std::function<void(Tick at, bool level)> on_change = {};
};

/// The source that was read, for the user.
struct LogicSource {
  std::string signal;
  int baud = 0;
};

/// Chooses the signal of the line: the only one, or the wanted one; else the first whose name is, in this order, line,
/// PBRXD, PBTXD or contains rxd, or txd. Throws CaptureError with the names. Names of scopes come before a dot.
std::size_t choose_signal(const std::vector<std::string>& names, const std::string& wanted);

class LogicDecoder {
 public:
  LogicDecoder(const LogicSettings& settings, TakeTelegram take);
  ~LogicDecoder();
  LogicDecoder(const LogicDecoder&) = delete;
  LogicDecoder& operator=(const LogicDecoder&) = delete;

  /// The line has this level from `at` on; in order of time. The same level again is allowed.
  void level(Tick at, bool level);
  /// End of the recording. Throws CaptureError if the rate cannot be found.
  void finish(Tick end);
  /// The rate, once it is known.
  std::optional<int> baud() const { return baud_; }

  /// The rate is detected from this many changes at the beginning, which are kept until then.
  static constexpr std::size_t kTrialChanges = 100'000;

 private:
  struct Change {
    Tick at;
    bool level;
  };
  class Line;

  void change(const Change& change);
  void decide(Tick end);
  int best_rate(Tick end) const;
  std::uint64_t worth(int baud, Tick end, bool inverted) const;

  std::optional<int> baud_;
  bool inverted_;
  TakeTelegram take_;
  std::function<void(Tick, bool)> on_change_;
  std::optional<bool> level_;
  std::vector<Change> waiting_;
  std::unique_ptr<Line> line_;
};

}  // namespace dsdpv1::bus::capture

#pragma once
// The log of a run: one line per event, in order of time. As text, or as one JSON object per line for programs
// (docs/log.md).
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "bus/bytes.hpp"
#include "bus/monitor/monitor.hpp"
#include "bus/time.hpp"
#include "io/output/output_file.hpp"
#include "tb/chip/user_cpu/place.hpp"

namespace dsdpv1::tb {

/// One event.
struct LogEntry {
  bus::Tick at =
      0;  ///< may lie slightly ahead of the present (the end of a telegram that is known before its last half bit)
  std::string station, kind, text;
  std::string code = {};                      ///< for events and checks
  std::optional<bus::Bytes> bytes = {};       ///< of a telegram, or data
  std::optional<double> tsdr_bits = {};       ///< for an answer
  std::string wrong = {};                     ///< the fault of a telegram
  std::optional<user_cpu::Place> where = {};  ///< of the user's act that caused it
};

/// `words`: the telegram as text.
LogEntry log_entry(const bus::WireTelegram& telegram, const std::string& words);

/// The format of the log.
struct LogForm {
  bool json = false;   ///< JSON lines, without abbreviation
  bool whole = false;  ///< text: all bytes of telegrams and data, not only the first kShownBytes
  bus::Tick from = 0;  ///< earlier events are skipped
  bool live = false;   ///< each line is in the file at once, for readers that follow it during the run

  static constexpr std::size_t kShownBytes = 32;
  std::size_t most_bytes() const { return json || whole ? static_cast<std::size_t>(-1) : kShownBytes; }
};

/// JSON lines if the file's name ends in .jsonl, else text.
LogForm log_form(const std::string& path, bool whole, bool live, bus::Tick from = 0);

class RunLog {
 public:
  /// Throws InputError if the file cannot be created.
  RunLog(const std::string& path, const LogForm& form) : file_(path), form_(form) {}

  void add(const LogEntry& entry);
  /// A finding of a check, or of a reader of telegrams: written after all other lines of that time, because views
  /// report the changes of one tick in different orders.
  void finding(const LogEntry& entry);
  /// No event before `now` will follow.
  void flush(bus::Tick now);
  /// Flushes the temporary file.
  void save() { file_.flush(); }
  void mute() { file_.mute(); }
  const std::string& grows_at() const { return file_.grows_at(); }
  bool failed() const { return file_.failed(); }
  void check() const { file_.check(); }
  /// Writes the rest and gives the file its name.
  void finish();

 private:
  void add(const LogEntry& entry, const char* joint, std::string order);

  OutputFile file_;
  LogForm form_;
  /// By time and station, because chips that act at the same time have no fixed order. Findings by their text.
  std::multimap<std::tuple<bus::Tick, std::string, std::string>, std::string> waiting_;
};

/// Nanoseconds with three decimals, from the absolute tick, rounded once: "1500.083".
std::string nanoseconds(bus::Tick tick);

}  // namespace dsdpv1::tb

#pragma once
// The log of a run: one line a thing, in order of time. As text for people, or a JSON object a line for programs
// (docs/log.md).
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "bus/bytes.hpp"
#include "bus/monitor/monitor.hpp"
#include "bus/time.hpp"
#include "io/output/output_file.hpp"

namespace dsdpv1::tb {

/// One thing that happened.
struct LogEntry {
  bus::Tick at =
      0;  ///< may lie a little ahead of the present (the end of a telegram that is known before its last half bit)
  std::string station, kind, text;
  std::string code = {};                 ///< of events and checks
  std::optional<bus::Bytes> bytes = {};  ///< of a telegram, of data
  std::optional<double> tsdr_bits = {};  ///< of an answer
  std::string wrong = {};                ///< what is wrong with a telegram
};

/// `words`: the telegram in words.
LogEntry log_entry(const bus::WireTelegram& telegram, const std::string& words);

/// How the log is written.
struct LogForm {
  bool json = false;   ///< JSON lines, everything whole
  bool whole = false;  ///< text: all bytes of telegrams and data, not the first kShownBytes only
  bus::Tick from = 0;  ///< what is before is left out
  bool live = false;   ///< each line is in the file at once, for whoever follows it while the run goes on

  static constexpr std::size_t kShownBytes = 32;
  std::size_t most_bytes() const { return json || whole ? static_cast<std::size_t>(-1) : kShownBytes; }
};

/// JSON lines for a file whose name ends in .jsonl, else text.
LogForm log_form(const std::string& path, bool whole, bool live, bus::Tick from = 0);

class RunLog {
 public:
  /// Throws InputError when the file cannot be created.
  RunLog(const std::string& path, const LogForm& form) : file_(path), form_(form) {}

  void add(const LogEntry& entry);
  /// What a check, or a reader of telegrams, found at the pins: after all other lines of that time, because views tell
  /// the changes of one tick in different orders.
  void finding(const LogEntry& entry);
  /// Nothing will come for a time before `now` any more.
  void flush(bus::Tick now);
  /// What was written is in the temporary file, which grows there.
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
  /// By time and station: chips that act at the same time are in no order of their own. Findings by their text.
  std::multimap<std::tuple<bus::Tick, std::string, std::string>, std::string> waiting_;
};

/// Nanoseconds with three digits after the point, from the absolute tick, rounded once: "1500.083".
std::string nanoseconds(bus::Tick tick);

}  // namespace dsdpv1::tb

#pragma once
// The log of a run: one line a thing, in order of time.
#include <map>
#include <string>
#include <tuple>

#include "bus/time.hpp"
#include "tb/report/output_file.hpp"

namespace tb {

class RunLog {
 public:
  /// Throws InputError when the file cannot be created.
  /// `live`: each line is in the file at once, for whoever follows it while the run goes on.
  explicit RunLog(const std::string& path, bool live = false) : file_(path), live_(live) {}

  /// A line for `at`, which may lie a little ahead of the present (the end of a telegram that is known before its last half bit).
  void line(bus::Tick at, const std::string& station, const std::string& kind, const std::string& text);
  /// What a check found: behind all other lines of that time, because views tell the changes of one tick in different orders.
  void finding(bus::Tick at, const std::string& station, const std::string& kind, const std::string& text);
  /// Nothing will come for a time before `now` any more.
  void flush(bus::Tick now);
  /// Writes the rest and gives the file its name.
  void finish();

 private:
  void add(bus::Tick at, const std::string& station, const std::string& kind, const std::string& text,
           std::string order);

  OutputFile file_;
  bool live_;
  /// By time and station: chips that act at the same time are in no order of their own. Findings by their text.
  std::multimap<std::tuple<bus::Tick, std::string, std::string>, std::string> waiting_;
};

/// Nanoseconds with three digits behind the point, from the absolute tick, rounded once: "1500.083".
std::string nanoseconds(bus::Tick tick);

}  // namespace tb

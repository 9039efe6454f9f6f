#pragma once
// The report of a run as a file: complete or absent.
#include <string>

#include "io/output/output_file.hpp"
#include "tb/bench/bench.hpp"
#include "tb/report/html/run_recorder.hpp"

namespace dsdpv1::tb::html {

class ReportFile {
 public:
  /// Becomes an observer of the run with these options. Throws InputError when the file cannot be created. `scenario`
  /// must outlive it, it the bench.
  ReportFile(const std::string& path, const scenario::Scenario& scenario, RunOptions& options);

  /// After the run; throws InputError when something could not be written. `version`: of the program.
  void write(const RunResult& result, const std::string& version);

 private:
  OutputFile file_;
  RunRecorder recorder_;
};

}  // namespace dsdpv1::tb::html

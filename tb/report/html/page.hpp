#pragma once
// The report of a run as one HTML page that loads nothing.
#include <string>

#include "tb/bench/record.hpp"
#include "tb/report/html/run_recorder.hpp"

namespace dsdpv1::tb::html {

/// `recorder` has recorded the whole run and is finished; `version`: of the program.
std::string page(const RunResult& result, const RunRecorder& recorder, const std::string& version);

}  // namespace dsdpv1::tb::html

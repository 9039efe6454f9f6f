#pragma once
// The data of the page as JSON. Times are ticks of 1/12 ns, except in the result, which is as --result writes it.
#include <string>

#include "tb/bench/record.hpp"
#include "tb/report/html/run_recorder.hpp"

namespace dsdpv1::tb::html {

/// Contains no '<', so that it can stand in a script element.
std::string page_data(const RunResult& result, const RunRecorder& recorder, const std::string& version);

}  // namespace dsdpv1::tb::html

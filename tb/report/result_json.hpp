#pragma once
#include <string>

#include "tb/bench/record.hpp"

namespace dsdpv1::tb {

/// The result file: one JSON object, indented, with a line end.
std::string result_json(const RunResult& result);

}  // namespace dsdpv1::tb

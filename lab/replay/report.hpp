#pragma once
// A replay's result in words, and for programs.
#include <string>

#include "lab/replay/result.hpp"
#include "tb/bench/record.hpp"

namespace dsdpv1::tb::replay {

/// Lines and tables, ended by EQUAL or DIFFERENT; `run`: the bench's result of the run, which may have failed even so.
std::string text(const Result& result, const RunResult& run);
/// docs/replay.md describes it.
std::string json(const Result& result);
/// A head, then a line for each request, separated by tabs.
std::string table(const Result& result);

}  // namespace dsdpv1::tb::replay

#pragma once
// A replay's result in words, and for programs.
#include <string>

#include "lab/replay/result.hpp"

namespace dsdpv1::tb::replay {

/// Lines and tables, ended by EQUAL or DIFFERENT.
std::string text(const Result& result);
/// docs/replay.md describes it.
std::string json(const Result& result);
/// A head, then a line for each request, separated by tabs.
std::string table(const Result& result);

}  // namespace dsdpv1::tb::replay

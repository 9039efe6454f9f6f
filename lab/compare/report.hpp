#pragma once
// A result in words, and for programs.
#include <string>

#include "lab/compare/result.hpp"

namespace dsdpv1::tb::compare {

/// Lines and a table, ended by EQUAL or DIFFERENT.
std::string text(const Result& result);
/// docs/compare.md describes it.
std::string json(const Result& result);
/// JUnit's XML: a case for each signal.
std::string junit(const Result& result);

}  // namespace dsdpv1::tb::compare

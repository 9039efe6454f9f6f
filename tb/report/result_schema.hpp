#pragma once
// What a result file holds, for programs and people.
#include <string>

namespace dsdpv1::tb {

constexpr const char* kResultSchema = "dsdpv1-sim result";  ///< the member "schema" of a result
constexpr const char* kResultVersion = "1.2";               ///< "version": when it changes says docs/result.md

/// JSON Schema (draft 2020-12) of result_json(): exact, what it does not name is wrong.
std::string result_schema();
/// docs/result.md.
std::string result_markdown();

}  // namespace dsdpv1::tb

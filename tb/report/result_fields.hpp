#pragma once
// The contents of the result file of a run, for programs and people.
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tb/bench/record.hpp"

namespace dsdpv1::tb {

class Fields;

/// The result file: one JSON object, indented, with a line end.
std::string result_json(const RunResult& result);
/// Its JSON Schema (draft 2020-12): exact, what it does not name is wrong.
std::string result_schema();
/// The `text` of a violation or event of a result file, with its place.
std::string text_and_place(const nlohmann::json& entry);
/// Of a difference, without slave and time; other files have them, too.
void difference_fields(Fields& out, const LockstepDifference& difference);
/// docs/result.md.
std::string result_markdown();

}  // namespace dsdpv1::tb

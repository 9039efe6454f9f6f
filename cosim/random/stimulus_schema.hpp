#pragma once
// What a result of rtl-random holds, for programs and people.
#include <string>

namespace dsdpv1::cosim {

/// JSON Schema (draft 2020-12) of result_json(StimulusResult): exact, what it does not name is wrong.
std::string stimulus_result_schema();
/// The table of docs/cosim.md.
std::string stimulus_result_table();

}  // namespace dsdpv1::cosim

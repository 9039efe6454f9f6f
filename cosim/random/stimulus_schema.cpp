#include "cosim/random/stimulus_schema.hpp"

#include "cosim/random/stimulus_result.hpp"
#include "tb/report/schema_words.hpp"

namespace dsdpv1::cosim {
namespace {

namespace words = tb::schema;
using words::Json;

Json case_that_differs() {
  return words::or_null(words::object({{"number", words::count("which one, from 1")},
                                       {"seed", words::count("that it alone is made from")},
                                       {"stimulus", words::text("the file that it was written to, made shorter")},
                                       {"actions", words::count("that it has there")}},
                                      "the random case that differs; null: none, or `--replay`"));
}

Json difference() {
  return words::or_null(words::object({{"cycle", words::count("of 48 MHz, when")},
                                       {"time_ns", words::number("when")},
                                       {"what", words::text("pin or cell of the DPRAM, and both values")},
                                       {"last_telegram", words::text("on the line")},
                                       {"last_access", words::text("of the user")},
                                       {"dpram", words::text("the chip's last access")}},
                                      "the first one of what the stimulus file says; null: none"));
}

Json coverage() {
  return words::object(
      {{"telegrams", words::named(words::count("how many"), "each kind, with its count")},
       {"codes", words::named(words::count("how often"), "each code of docs/reasons.md, with its count")},
       {"situations", words::or_null(words::named(
                          words::named(words::count("how often"), "each situation, with its count"),
                          "each group: states, services, events, situations at the host port; null: `--replay`"))}},
      "what occurred");
}

Json root() {
  return words::object(
      {{"schema", words::constant(kStimulusResultSchema, "what this file is")},
       {"version", words::constant(kStimulusResultVersion, "of what it holds")},
       {"verdict", words::one_of({"same", "different"}, "of model and RTL")},
       {"rtl", words::or_null(words::text("the folder of `--rtl`; null: the reference RTL"))},
       {"fault", words::or_null(words::count("the number of `--fault`; null: none"))},
       {"seed", words::count("of the random cases, and of what the reference RTL begins with")},
       {"replayed", words::or_null(words::text("the stimulus of `--replay`; null: random cases"))},
       {"cases",
        words::or_null(words::count("random cases, up to and including the one that differs; null: `--replay`"))},
       {"cycles", words::count("that were compared and are the same")},
       {"pin_changes", words::count("likewise")},
       {"dpram_images", words::count("likewise")},
       {"case", case_that_differs()},
       {"difference", difference()},
       {"coverage", coverage()}},
      "what came of random cases, or of a stimulus that was played");
}

}  // namespace

std::string stimulus_result_schema() { return words::document(kStimulusResultSchema, root()); }

std::string stimulus_result_table() { return "| member | type | what |\n|---|---|---|\n" + words::rows(root()); }

}  // namespace dsdpv1::cosim

// A stimulus file; written again and read again it is the same.
#include "cosim/random/stimulus.hpp"

#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/kind.hpp"
#include "tests/fuzz/input.hpp"

namespace dsdpv1 {

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const tb::ChipKind& kind = tb::kind_of(Part::kRsu);
  cosim::Stimulus stimulus;
  try {
    stimulus = cosim::parse_stimulus(text, "a.stim", kind);
  } catch (const tb::InputError& error) {
    fuzz::promise_named(error.what(), "a.stim");
    return 0;
  }
  constexpr std::size_t kShort = 2000;  // longer ones only repeat the same
  if (stimulus.size() > kShort) return 0;
  const std::string written = cosim::to_text(stimulus, kind);
  fuzz::promise(cosim::to_text(cosim::parse_stimulus(written, "again.stim", kind), kind) == written,
                "what is written can be read");
  return 0;
}

}  // namespace dsdpv1

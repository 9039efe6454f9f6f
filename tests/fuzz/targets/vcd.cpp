// A wave as text. Another target handles input that begins as FST.
#include "tests/fuzz/wave_events.hpp"

namespace dsdpv1 {

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size != 0 && (data[0] == 0 || data[0] == 254)) return 0;
  fuzz::read_wave(data, size);
  return 0;
}

}  // namespace dsdpv1

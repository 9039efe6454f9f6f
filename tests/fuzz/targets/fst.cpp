// A wave in FST. The library that reads it may crash of a damaged file, in a process of its own; the reader may not.
#include "tests/fuzz/wave_events.hpp"

using namespace dsdpv1;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || (data[0] != 0 && data[0] != 254)) return 0;
  fuzz::read_wave(data, size);
  return 0;
}

// A table of a logic analyser: Saleae Logic's changes, sigrok's samples.
#include <sstream>

#include "bus/baud.hpp"
#include "bus/capture/csv_reader.hpp"
#include "tests/fuzz/captured.hpp"

namespace dsdpv1 {

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  fuzz::read_capture([&] { bus::capture::read_csv(in, {}, fuzz::take); });
  return 0;
}

}  // namespace dsdpv1

// Telegrams out of text: hexadecimal, the log of a run, JSON lines.
#include <sstream>

#include "bus/telegram/explain.hpp"
#include "tests/fuzz/input.hpp"

namespace dsdpv1 {

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  std::ostringstream out;
  std::string error;
  const int status = bus::decode_text(in, "a.log", out, error);
  fuzz::promise(status >= 0 && status <= 2, "the exit code is 0, 1 or 2");
  fuzz::promise((status == 2) == !error.empty(), "exit code 2 and an error come together");
  if (status != 2) return 0;
  fuzz::promise(out.str().empty(), "nothing is printed beside an error");
  fuzz::promise_named(error, "a.log");
  return 0;
}

}  // namespace dsdpv1

// Telegrams out of text: hexadecimal, the log of a run, JSON lines, logs of other programs.
#include <sstream>

#include "bus/capture/text_reader.hpp"
#include "tests/fuzz/input.hpp"

namespace dsdpv1 {

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace capture = bus::capture;
  for (const std::optional<int> baud : {std::optional<int>(), std::optional<int>(9)}) {
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    std::size_t bytes = 0;
    try {
      capture::read_text(in, baud, [&](const capture::CapturedTelegram& telegram) {
        bytes += telegram.bytes.size();
        fuzz::promise(!telegram.bytes.empty(), "a telegram has bytes");
        fuzz::promise(telegram.line > 0, "a telegram has its line");
        fuzz::promise(telegram.start <= telegram.end, "a telegram ends after its start");
      });
      fuzz::promise(bytes <= size, "no byte is made up");
    } catch (const capture::CaptureError& error) {
      fuzz::promise(error.line() > 0, "an error names its line");
      fuzz::promise(bytes == 0, "nothing is taken before an error");
    }
  }
  return 0;
}

}  // namespace dsdpv1

// Packets: pcapng and pcap, by how the file begins.
#include <sstream>

#include "bus/baud.hpp"
#include "bus/capture/pcap_reader.hpp"
#include "tests/fuzz/captured.hpp"

namespace dsdpv1 {

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  std::istringstream in(bytes);
  fuzz::read_capture([&] {
    if (bus::capture::begins_as_pcap(bytes)) return bus::capture::read_pcap(in, fuzz::take);
    bus::capture::read_pcapng(in, fuzz::take);
  });
  return 0;
}

}  // namespace dsdpv1

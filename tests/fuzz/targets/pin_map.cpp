// A map of pins, for a user's RTL.
#include "cosim/pin_map.hpp"

#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/pins/pin_table.hpp"
#include "tests/fuzz/input.hpp"

namespace dsdpv1 {

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const cosim::PinMap map = cosim::parse_pin_map(std::string(reinterpret_cast<const char*>(data), size), "pins.yaml",
                                                   tb::pins_of(Part::kRsu), {"u_timer"});
    fuzz::promise(map.pins.size() == cosim::default_pin_map(tb::pins_of(Part::kRsu)).pins.size(),
                  "a map renames pins and makes none");
    fuzz::promise(!map.clock.name.empty(), "a port has a name");
  } catch (const tb::InputError& error) {
    fuzz::promise_named(error.what(), "pins.yaml");
  }
  return 0;
}

}  // namespace dsdpv1

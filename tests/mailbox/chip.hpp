#pragma once
// The mailbox: a DP slave with 8 bytes of inputs, 8 bytes of outputs and a SPI port (spi_port.hpp). It is not a real
// chip; it tests model/profibus/ with a user's side that has nothing in common with a dual-port RAM.
//
//   Chip chip;                                     // RESET is low
//   chip.watch({&on_pin, self}, kOutputPins);
//   chip.set(20 * 250, Pin::kReset, 1);            // release reset at cycle 20
//   chip.advance(48'000 * 250);                    // one millisecond
//
// A change of an input made at tick t is seen by the first rising CLK edge strictly after t; the SPI port, which is
// asynchronous to CLK, sees it at t. Calls must be made in order of time: `set` first runs the chip up to its own tick.
#include <cstdint>
#include <memory>

#include "model/profibus/baud.hpp"
#include "model/profibus/dp_state.hpp"
#include "model/profibus/event.hpp"
#include "tests/mailbox/pins.hpp"

namespace dsdpv1::mailbox {

enum class Engine : std::uint8_t {
  kStep,  ///< every cycle of every block is evaluated
  kSkip,  ///< sleeps until the next cycle at which a block does something; the same pin trace
};

struct Config {
  Engine engine = Engine::kSkip;
};

using profibus::DpState;

/// Counters and states; reading it changes nothing.
struct Status {
  DpState dp_state = DpState::kOffline;
  profibus::BaudIndex baud_index;        ///< none while searching
  std::uint8_t address = 0;              ///< 0 before the start
  std::uint8_t master = 255;             ///< the parameterising master, 255 = none
  std::uint64_t telegrams_received = 0;  ///< error-free telegrams of all stations
  std::uint64_t telegrams_answered = 0;
  std::uint64_t data_exchanges = 0;  ///< repetitions not counted
  std::uint64_t outputs_missed = 0;  ///< blocks that newer ones replaced before a frame had loaded them
};

class Chip {
 public:
  explicit Chip(const Config& config = {});
  ~Chip();
  Chip(const Chip&) = delete;
  Chip& operator=(const Chip&) = delete;

  /// Changes an input pin at tick `at` (>= every earlier call's). Setting a pin to the level it has does nothing.
  /// Before the first call RESET, SCK and MOSI are low, XSS and PBRXD are high.
  void set(Tick at, Pin pin, Level level);
  /// Evaluates everything up to and including tick `to`; pin changes and events leave through the sinks on the way.
  void advance(Tick to);
  /// The tick of the next rising CLK edge at which the chip acts by itself; never before `now()`. With Engine::kStep
  /// the next rising edge.
  Tick next_event() const;
  Tick now() const;
  /// The present level of a pin, input or output.
  Level level(Pin pin) const;

  /// Reports changes of the output pins in `pins` (see mask(Pin)). One sink; a second call replaces it.
  void watch(const PinSink& sink, std::uint32_t pins);
  void on_event(const profibus::EventSink& sink);

  Status status() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dsdpv1::mailbox

#pragma once
// The other end of the SPI port: a small controller that starts the chip once and then, in each period, reads the
// outputs and writes the inputs.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bus/timeline.hpp"
#include "tb/chip/user_cpu/user_side.hpp"
#include "tests/mailbox/pins.hpp"

namespace dsdpv1::mailbox {

/// The chip's pins as seen by the user.
class SpiPins : public user_cpu::UserSide {
 public:
  virtual void set(Tick at, Pin pin, Level level) = 0;
  virtual Level level(Pin pin) const = 0;
};

struct UserConfig {
  Tick start = 10 * bus::kTicksPerUs;    ///< start of frame 03; RESET must be high by then
  Tick period = 100 * bus::kTicksPerUs;  ///< from one read of the outputs to the next
  Tick sck_period = 1200;                ///< 10 MHz; an even number, and at least 500: see User::frame_gap
  std::uint8_t address = 5;
  std::uint16_t ident = 0x0B0C;
};

using Data = std::array<std::uint8_t, 8>;

class User : public bus::Agent {
 public:
  struct Counters {
    std::uint64_t frames = 0;            ///< for all three commands
    std::uint64_t outputs_received = 0;  ///< reads that INT had announced
    std::uint64_t inputs_written = 0;
  };

  /// `pins` must outlive it; add it to the timeline after the chip.
  explicit User(SpiPins& pins, const UserConfig& config = {}) : pins_(pins), config_(config), due_(config.start) {}

  /// The inputs from the next frame on; until then, and after `loop_back`, they are the outputs read last.
  void set_inputs(const Data& inputs) { inputs_ = inputs; }
  void loop_back() { inputs_.reset(); }
  /// The outputs read last.
  const Data& outputs() const { return outputs_; }
  const Counters& counters() const { return counters_; }

  bus::Tick next() const override { return due_; }
  void run(bus::Tick now) override;

 private:
  enum class Edge : std::uint8_t { kSelect, kRise, kFall, kDeselect };
  /// XSS high between two frames: at least the two cycles (500 ticks) after which a frame takes effect.
  Tick frame_gap() const { return config_.sck_period; }
  void plan(Edge edge, Tick at) {
    edge_ = edge;
    due_ = at;
  }
  void select(Tick now);
  void rise(Tick now);
  void fall(Tick now);
  void deselect(Tick now);
  void show_bit(Tick now);
  void begin(const std::vector<std::uint8_t>& bytes, Tick at);
  void begin_read(Tick now);
  void begin_write(Tick now);

  SpiPins& pins_;
  const UserConfig config_;
  std::optional<Data> inputs_;
  Data outputs_{};
  Counters counters_;

  Edge edge_ = Edge::kSelect;
  Tick due_;
  std::vector<std::uint8_t> sent_, received_;  // bytes of the present frame; empty: it starts the chip
  std::size_t bit_ = 0;
  bool announced_ = false;  // INT was low when the frame began
  Tick cycle_ = 0;          // due time of the last read
};

}  // namespace dsdpv1::mailbox

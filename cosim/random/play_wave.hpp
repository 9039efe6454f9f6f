#pragma once
// The model's side of a played stimulus as a wave: pins, internal signals, telegrams. The RTL's side comes from its
// trace (joined_wave.hpp).
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cosim/random/player.hpp"
#include "io/waves/wave_writer.hpp"
#include "tb/chip/chip_kind.hpp"

namespace dsdpv1::cosim {

class PlayWave : public PlayListener {
 public:
  /// Scopes `bus` and `chip`, as in the waves of scenarios; both directions of D separately. Throws tb::InputError.
  PlayWave(const std::string& path, const std::string& chip, const tb::ChipKind& kind);
  /// Evaluates every cycle of the model from now on and listens.
  void listen(PlayOptions& options);

  void begins(const tb::PinDevice& both) override;
  void pin(Tick at, Side side, PinNumber pin, Level level) override;
  void telegram(Tick now, const bus::WireTelegram& telegram) override;
  void evaluated(Tick now, tb::PinDevice& model) override;
  /// Gives the file its name; throws tb::InputError if it cannot be written.
  void ends(Tick end, const Lockstep& lockstep) override;

 private:
  using Signal = tb::WaveWriter::Signal;
  void inside(Tick at, std::size_t signal, Level level, const std::string& word);
  /// The host's edges are reported when they happen, the chip's when it is evaluated.
  Tick in_order(Tick at) { return last_ = std::max(at, last_); }

  std::unique_ptr<tb::WaveWriter> writer_;
  Signal telegram_ = 0;
  std::vector<Signal> pins_;
  std::vector<Signal> inside_;
  const std::vector<tb::InnerSignal>& signals_;
  Tick last_ = 0;
};

}  // namespace dsdpv1::cosim

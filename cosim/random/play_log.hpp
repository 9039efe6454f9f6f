#pragma once
// Log of a stimulus that is played: every change of every pin, the model's events, telegrams, the difference.
#include <string>

#include "cosim/random/play_listener.hpp"
#include "tb/bench/run_log.hpp"

namespace dsdpv1::cosim {

class PlayLog : public PlayListener {
 public:
  /// Writes JSON lines to a file whose name ends in .jsonl; throws tb::InputError if it cannot be created.
  PlayLog(const std::string& path, const tb::ChipKind& kind)
      : kind_(kind), log_(path, tb::log_form(path, false, false)) {}

  void pin(Tick at, Side side, PinNumber pin, Level level) override;
  void event(const profibus::Event& event) override;
  void telegram(Tick now, const bus::WireTelegram& telegram) override;
  /// Gives the file its name; throws tb::InputError if it cannot be written.
  void ends(Tick end, const Lockstep& lockstep) override;

 private:
  const tb::ChipKind& kind_;
  tb::RunLog log_;
};

}  // namespace dsdpv1::cosim

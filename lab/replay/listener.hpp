#pragma once
// Observes the run of a replay: finds the model's telegrams and the request to which each belongs.
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "lab/replay/replayed_line.hpp"
#include "lab/replay/result.hpp"
#include "tb/bench/observer.hpp"

namespace dsdpv1::tb::replay {

/// The model's reaction to a telegram of the capture.
struct Heard {
  bool whole = false;     ///< it was on the line undisturbed
  bool has_rate = false;  ///< the model had the telegram's baud rate at its end
  std::optional<Answer> answer;
};

class Listener : public Observer {
 public:
  /// All arguments must outlive it.
  Listener(const Recording& recording, const std::vector<PlacedTelegram>& placed);

  void begins(std::size_t /*slave*/, const ChipView& chip) override { chip_ = &chip; }
  void telegram(const HeardTelegram& heard) override;
  /// The capture is played from now on, its times shifted by this.
  void begin(Tick shift) { shift_ = shift; }
  /// Until the next `begin`.
  void pause() { shift_.reset(); }

  bool model_has_rate(int baud) const { return chip_ != nullptr && chip_->status().baud == baud; }
  /// By position in Recording::telegrams.
  const Heard* of(std::size_t telegram) const;
  /// Telegrams of the model without a request, or after its answer.
  const std::vector<Answer>& unasked() const { return unasked_; }

 private:
  void take_answer(const bus::WireTelegram& wire, Tick start, const PlacedTelegram& before);

  const Recording& recording_;
  const std::vector<PlacedTelegram>& placed_;
  const ChipView* chip_ = nullptr;
  std::optional<Tick> shift_;
  std::vector<Heard> heard_;                     ///< by position in placed_
  std::map<std::size_t, std::size_t> requests_;  ///< position in placed_ by that in Recording::telegrams
  std::vector<bool> asks_;                       ///< by position in placed_: a request to the slave
  std::vector<Answer> unasked_;
};

}  // namespace dsdpv1::tb::replay

#pragma once
// Decodes telegrams from one signal of a recording.
#include "bus/capture/level_taker.hpp"
#include "bus/capture/logic_decoder.hpp"

namespace dsdpv1::bus::capture {

class SignalDecoder : public LevelTaker {
 public:
  SignalDecoder(const LogicSettings& settings, TakeTelegram take)
      : wanted_(settings.signal), decoder_(settings, std::move(take)) {}

  std::vector<std::size_t> choose(const std::vector<std::string>& names) override {
    const std::size_t chosen = choose_signal(names, wanted_);
    name_ = names[chosen];
    return {chosen};
  }
  void level(Tick at, std::size_t /*which*/, bool level) override { decoder_.level(at, level); }
  void finish(Tick end) override { decoder_.finish(end); }
  /// Valid after the end.
  LogicSource source() const { return {name_, *decoder_.baud()}; }

 private:
  std::string wanted_, name_;
  LogicDecoder decoder_;
};

}  // namespace dsdpv1::bus::capture

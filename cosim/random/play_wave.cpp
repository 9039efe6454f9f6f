#include "cosim/random/play_wave.hpp"

#include "bus/telegram/explain.hpp"

namespace dsdpv1::cosim {

PlayWave::PlayWave(const std::string& path, const std::string& chip, const tb::ChipKind& kind)
    : writer_(tb::open_wave(path)), signals_(kind.inner_signals()) {
  writer_->open_scope("bus");
  telegram_ = writer_->words("telegram");
  writer_->close_scope();
  writer_->open_scope(chip);
  for (const tb::PinInfo& pin : kind.pins()) pins_.push_back(writer_->wire(pin.name, pin.width));
  writer_->open_scope("inside");
  for (const tb::InnerSignal& each : signals_)
    inside_.push_back(each.width == 0 ? writer_->words(each.name) : writer_->wire(each.name, each.width));
  writer_->close_scope();
  writer_->close_scope();
}

void PlayWave::listen(PlayOptions& options) {
  options.engine = tb::Engine::kStep;
  options.listeners.push_back(this);
}

void PlayWave::begins(const tb::PinDevice& both) {
  writer_->say(0, telegram_, "-");
  for (std::size_t i = 0; i < pins_.size(); ++i) writer_->set(0, pins_[i], both.level(static_cast<PinNumber>(i)));
}

void PlayWave::pin(Tick at, Side side, PinNumber pin, Level level) {
  if (side != Side::kRtl) writer_->set(in_order(at), pins_[pin], level);
}

void PlayWave::telegram(Tick now, const bus::WireTelegram& telegram) {
  const bus::Decoded& decoded = telegram.decoded;
  writer_->say(in_order(now), telegram_, decoded.readable ? bus::explain_line(decoded.telegram) : "not readable");
}

void PlayWave::evaluated(Tick now, tb::PinDevice& model) {
  struct Inside : tb::ChipListener {
    explicit Inside(PlayWave& wave) : wave_(wave) {}
    void inside(std::size_t, Tick at, std::size_t signal, Level level, const std::string& word) override {
      wave_.inside(at, signal, level, word);
    }
    PlayWave& wave_;
  } listener(*this);
  model.look_inside(now, 0, listener);
}

void PlayWave::inside(Tick at, std::size_t signal, Level level, const std::string& word) {
  if (signals_[signal].width == 0)
    writer_->say(in_order(at), inside_[signal], word);
  else
    writer_->set(in_order(at), inside_[signal], level);
}

void PlayWave::ends(Tick end, const Lockstep& /*lockstep*/) { writer_->finish(in_order(end)); }

}  // namespace dsdpv1::cosim

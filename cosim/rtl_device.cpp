#include "cosim/rtl_device.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::cosim {

PinNumber data_output(const tb::PinTable& pins) {
  for (PinNumber pin = 0; pin < end_of(pins); ++pin)
    if (!pins[pin].input && pins[pin].bus != nullptr) return pin;
  return kNoPin;
}

RtlDevice::RtlDevice(std::unique_ptr<tb::PinDevice> core, std::unique_ptr<Rtl> rtl, const tb::ChipKind& kind,
                     const tb::OwnSettings& chip)
    : core_(std::move(core)), rtl_(std::move(rtl), kind, chip, *core_), data_(data_output(kind.pins())) {
  for (PinNumber pin = 0; pin < end_of(kind.pins()); ++pin)
    if (!kind.pins()[pin].input && pin != data_ && core_->level(pin) == tb::kLevelX) unknown_ |= tb::mask_of(pin);
  core_->watch({[](void* self, Tick at, PinNumber pin, Level level) {
                  static_cast<RtlDevice*>(self)->core_changes_.push_back({at, pin, level});
                },
                this},
               data_ == kNoPin ? 0 : tb::mask_of(data_));
  rtl_.watch({[](void* self, Tick at, PinNumber pin, Level level) {
                static_cast<RtlDevice*>(self)->rtl_changes_.push_back({at, pin, level});
              },
              this},
             tb::outputs_of(kind.pins()));
}

void RtlDevice::watch(const tb::PinSink& sink, tb::PinMask pins) {
  sink_ = sink;
  watched_ = pins & ~unknown_;
}

void RtlDevice::set(Tick at, PinNumber pin, Level level) {
  advance(at);
  core_->set(at, pin, level);
  rtl_.set(at, pin, level);
  pass_on();
}

void RtlDevice::advance(Tick to) {
  core_->advance(to);
  rtl_.advance(to);
  pass_on();
}

/// The RTL does not know when the user samples: before Tw (P5) the core reports that D is unknown.
Level RtlDevice::sample(Tick at) {
  advance(at);
  return core_->sample(at) == tb::kLevelX ? tb::kLevelX : d_;
}

/// Both sides have reported their changes in order of time, one side after the other.
void RtlDevice::pass_on() {
  while (core_next_ < core_changes_.size() || rtl_next_ < rtl_changes_.size()) {
    Tick at = core_next_ < core_changes_.size() ? core_changes_[core_next_].at : rtl_changes_[rtl_next_].at;
    if (rtl_next_ < rtl_changes_.size()) at = std::min(at, rtl_changes_[rtl_next_].at);
    pass_on_tick(at);
  }
  core_changes_.clear();
  rtl_changes_.clear();
  core_next_ = rtl_next_ = 0;
}

void RtlDevice::pass_on_tick(Tick at) {
  for (; core_next_ < core_changes_.size() && core_changes_[core_next_].at == at; ++core_next_)
    core_d_ = core_changes_[core_next_].level;
  for (; rtl_next_ < rtl_changes_.size() && rtl_changes_[rtl_next_].at == at; ++rtl_next_) {
    const Change& change = rtl_changes_[rtl_next_];
    if (change.pin == data_)
      rtl_d_ = change.level;
    else
      tell(at, change.pin, change.level);
  }
  const bool unknown = core_d_ == tb::kLevelX && rtl_d_ != tb::kLevelZ;
  const Level d = unknown ? tb::kLevelX : rtl_d_;
  if (std::exchange(d_, d) != d) tell(at, data_, d);
}

void RtlDevice::tell(Tick at, PinNumber pin, Level level) {
  if (sink_.call != nullptr && (watched_ & tb::mask_of(pin)) != 0) sink_.call(sink_.self, at, pin, level);
}

}  // namespace dsdpv1::cosim

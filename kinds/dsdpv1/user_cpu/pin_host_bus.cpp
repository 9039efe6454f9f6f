#include "kinds/dsdpv1/user_cpu/pin_host_bus.hpp"

namespace dsdpv1::user_cpu {

void PinHostBus::set_r_req(Tick at, bool level) { chip_.set(at, number(Pin::kRReq), level ? 1 : 0); }

void PinHostBus::set_r_sta(Tick at, bool level) { chip_.set(at, number(Pin::kRSta), level ? 1 : 0); }

bool PinHostBus::l_req(Tick at) { return is_high(at, Pin::kLReq); }

bool PinHostBus::l_sta(Tick at) { return is_high(at, Pin::kLSta); }

bool PinHostBus::intr0(Tick at) { return is_high(at, Pin::kIntr0); }

unsigned PinHostBus::lamps(Tick at) {
  const auto bit = [&](Pin pin) { return static_cast<unsigned>(is_high(at, pin)); };
  return bit(Pin::kPbf) | bit(Pin::kBr) << 1U | bit(Pin::kReady) << 2U;
}

bool PinHostBus::is_high(Tick at, Pin pin) {
  chip_.advance(at);
  return chip_.level(number(pin)) == 1;
}

void PinHostBus::begin(Tick at, const Access& access, const AccessTiming& timing) {
  access_ = &maker_.make(access.write, access.address, access.value, timing);
  begin_ = at;
  edge_ = 0;
  end_ = at + access_->duration();
  if (!access.write) sample_tick_ = at + access_->sample();
}

void PinHostBus::run_edges(Tick until) {
  for (; next_edge() <= until; ++edge_) {
    const dsdpv1::HostAccess::Edge& edge = (*access_)[edge_];
    if (edge.pin == Pin::kDOut)
      sample(begin_ + edge.at);
    else
      chip_.set(begin_ + edge.at, number(edge.pin), edge.level);
  }
}

bool PinHostBus::run_whole(bool may_report) {
  Level sampled = 0;
  if (edge_ > 0 || core_ == nullptr || !core_->carry_out(begin_, *access_, sampled, may_report)) return false;
  edge_ = access_->size();
  if (!access_->is_write()) take(sampled);
  return true;
}

void PinHostBus::sample(Tick at) { take(chip_.sample(at)); }

void PinHostBus::take(Level level) {
  bad_ = level < 0;
  value_ = bad_ ? std::uint8_t{0xFF} : static_cast<std::uint8_t>(level);
}

}  // namespace dsdpv1::user_cpu

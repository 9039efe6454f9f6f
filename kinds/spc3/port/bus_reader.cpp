#include "kinds/spc3/port/bus_reader.hpp"

namespace dsdpv1::spc3_bus {

using spc3::Pin;

void BusReader::pin(Tick at, tb::PinNumber pin, Level level) {
  const auto which = static_cast<Pin>(pin);
  if (which == Pin::kReset) return reset(level != 0);
  if (which == Pin::kDbOut) {
    if (!running_ || access_.write || level < 0) return;
    access_.address = lines_.address();
    access_.data = level;
    return sink_.read_answered(at, access_);
  }
  if (!spc3::is_input(which) || !lines_.set(which, level) || in_reset_) return;
  if (which != Pin::kDbIn) follow(at);
}

void BusReader::reset(bool high) {
  in_reset_ = high;
  running_ = false;
}

void BusReader::follow(Tick at) {
  const bool reads = lines_.reads(), writes = lines_.writes();
  if (running_ && !(access_.write ? writes : reads)) {
    running_ = false;
    if (access_.write) {
      access_.address = lines_.address();
      access_.data = lines_.level(Pin::kDbIn) < 0 ? tb::kLevelX : lines_.level(Pin::kDbIn);
    }
    sink_.access_ended(at, access_);
  }
  if (running_ || (!reads && !writes)) return;
  running_ = true;
  access_ = {writes && !reads, lines_.address(), tb::kLevelX, at};
  sink_.access_began(access_);
}

}  // namespace dsdpv1::spc3_bus

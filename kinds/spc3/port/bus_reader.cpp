#include "kinds/spc3/port/bus_reader.hpp"

namespace dsdpv1::spc3_bus {

using spc3::Pin;

// --- SPI -------------------------------------------------------------------------------------------------------------

void SpiReader::pin(Tick at, Pin pin, Level level) {
  switch (pin) {
    case Pin::kXss: return read(at, tb::SpiWire::kXss, level);
    case Pin::kSck: return read(at, tb::SpiWire::kSck, level);
    case Pin::kMosi: return read(at, tb::SpiWire::kMosi, level);
    case Pin::kMiso: return read(at, tb::SpiWire::kMiso, level);
    default: return;
  }
}

void SpiReader::frame_began(Tick at) {
  frame_.began = at;
  frame_.out.clear();
  frame_.in.clear();
}

void SpiReader::byte(Tick at, std::uint8_t mosi, std::uint8_t miso) {
  frame_.out.push_back(mosi);
  frame_.in.push_back(miso);
  if (!frame_.is_known() || frame_.data() == 0 || (!frame_.is_array() && frame_.data() > 1)) return;
  constexpr unsigned kMap = 0xFFF;
  const auto address = static_cast<Level>((frame_.address() + frame_.data() - 1) & kMap);
  const bool write = !frame_.is_read();
  BusAccess access = {write, address, tb::kLevelX, byte_start()};
  sink_.access_began(access);
  access.data = write ? mosi : miso;
  if (!write) sink_.read_answered(at, access);
  sink_.access_ended(at, access);
}

void SpiReader::frame_ended(Tick at) {
  frame_.ended = at;
  frame_.bits = bits() % 8;
  sink_.frame_ended(frame_);
}

// --- the parallel buses ----------------------------------------------------------------------------------------------

void BusReader::pin(Tick at, tb::PinNumber pin, Level level) {
  const auto which = static_cast<Pin>(pin);
  if (which == Pin::kReset) return reset(level != 0);
  if (which >= Pin::kSerial) return serial(at, which, level);
  if (which == Pin::kDbOut) {
    if (!running_ || access_.write || level < 0) return;
    access_.address = lines_.address();
    access_.data = level;
    return sink_.read_answered(at, access_);
  }
  if (!spc3::is_input(which) || !lines_.set(which, level) || in_reset_) return;
  if (which != Pin::kDbIn) follow(at);
}

void BusReader::serial(Tick at, Pin pin, Level level) {
  if (spc3::is_input(pin)) lines_.set(pin, level);
  if (!in_reset_ && lines_.bus() == spc3::Bus::kSpi) spi_.pin(at, pin, level);
}

void BusReader::reset(bool high) {
  in_reset_ = high;
  running_ = false;
  if (high) spi_.forget_frame();
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

#include "tb/dsdpv1/user_cpu/serial_port.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1::user_cpu {
namespace {

SerialPort& self(void* ctx) { return *static_cast<SerialPort*>(ctx); }

/// A write of one byte to B014 (SP12) in the frame; -1: another telegram.
int ownership(const std::vector<std::uint8_t>& out) {
  const bool write = out.size() > 10 && out[0] >> 5 == 1 && out[1] == 0x00 && out[2] == 0x14 && out[3] == 1;
  return write ? out[4] : -1;
}

/// The reply is a write's, without an error.
bool granted(const std::vector<std::uint8_t>& in) {
  constexpr std::size_t kRequest = 7;
  const auto first = std::find_if(in.begin() + kRequest, in.end(), [](std::uint8_t byte) { return byte != 0xFF; });
  return first != in.end() && *first >> 5 == 5;
}

constexpr std::size_t kFaultAt = 2;  ///< byte of a telegram that goes wrong

}  // namespace

SerialPort::SerialPort(Cpu& cpu, const HostPort& port) : cpu_(cpu), pins_(cpu.serial_pins()), port_(port) {
  if (const auto* spi = std::get_if<SpiPort>(&port.port)) spi_master_ = pins_.make_spi_master(spi->timing);
  if (const auto* uart = std::get_if<UartPort>(&port.port)) {
    uart_sender_ = pins_.make_uart_sender(uart->timing);
    receiver_ = UartReceiver(uart->timing);
    pins_.on_txd = [this](Tick at, bool level) {
      receiver_.txd_changed(at, level);
      cpu_.transfer_changed();
    };
  }
}

SerialPort::~SerialPort() { pins_.on_txd = nullptr; }

dsdpv1_error SerialPort::open(dsdpv1_device& device, const dsdpv1_judge& judge) {
  spi_.ctx = uart_.ctx = this;
  spi_.address = uart_.address = port_.address;
  spi_.block_crc = uart_.block_crc = port_.block_crc;
  spi_.pause = uart_.pause = [](void* ctx, std::uint32_t ns) { self(ctx).pause(ns); };
  dsdpv1_error error = DSDPV1_OK;
  if (const auto* spi = std::get_if<SpiPort>(&port_.port)) {
    spi_.spare = spi->spare;
    spi_.exchange = [](void* ctx, const std::uint8_t* out, std::uint8_t* in, std::uint16_t n) {
      return self(ctx).frame(out, in, n);
    };
    error = dsdpv1_open_spi(&device, &spi_, &judge);
  } else if (const auto* uart = std::get_if<UartPort>(&port_.port)) {
    uart_.baud = static_cast<std::uint32_t>(uart->timing.baud);
    uart_.interval = uart->interval;
    uart_.tsdr = uart->tsdr;
    uart_.send = [](void* ctx, const std::uint8_t* bytes, std::uint16_t n) { return self(ctx).send(bytes, n); };
    uart_.receive = [](void* ctx, std::uint8_t* bytes, std::uint16_t n, std::uint32_t timeout_us) {
      return self(ctx).receive(bytes, n, timeout_us);
    };
    error = dsdpv1_open_uart(&device, &uart_, &judge);
  }
  device.tuning.poll_pause_ns = static_cast<std::uint32_t>(cpu_.timing().poll_interval / bus::kTicksPerNs);
  return error;
}

void SerialPort::spoil(TelegramFault fault, int times) {
  fault_ = fault;
  spoilt_ = times;
}

bool SerialPort::is_spoilt(TelegramFault fault) {
  if (fault_ != fault || spoilt_ <= 0) return false;
  --spoilt_;
  return true;
}

void SerialPort::pause(std::uint32_t ns) { cpu_.wait(static_cast<Tick>(ns) * bus::kTicksPerNs); }

bool SerialPort::frame(const std::uint8_t* out, std::uint8_t* in, std::size_t n) {
  SpiMaster& master = *spi_master_;
  const std::vector<std::uint8_t> bytes(out, out + n);
  const Tick begun = cpu_.now();
  SpiFault fault;
  if (is_spoilt(TelegramFault::kFlippedBit)) fault.flipped_bit = 8 * kFaultAt;
  if (is_spoilt(TelegramFault::kCut)) fault.cut_after = 8 * kFaultAt + 3;
  master.begin(begun, bytes, fault);
  cpu_.transfer(master);
  std::copy(master.received().begin(), master.received().end(), in);
  count_hold(bytes, master.received(), begun);
  return true;
}

void SerialPort::count_hold(const std::vector<std::uint8_t>& out, const std::vector<std::uint8_t>& in, Tick begun) {
  const int value = ownership(out);
  if (value < 0) return;
  if (value == 2 && held_at_ < 0) {
    if (asked_at_ < 0) asked_at_ = begun;
    if (!granted(in)) return;
    held_at_ = cpu_.now();
    ++counters_.holds;
    counters_.longest_wait = std::max(counters_.longest_wait, held_at_ - std::exchange(asked_at_, -1));
  } else if (value == 0 && held_at_ >= 0 && granted(in)) {
    counters_.longest_hold = std::max(counters_.longest_hold, cpu_.now() - std::exchange(held_at_, -1));
  }
}

bool SerialPort::send(const std::uint8_t* bytes, std::size_t n) {
  UartFault fault;
  if (is_spoilt(TelegramFault::kFlippedBit)) fault.flipped_bit = 8 * kFaultAt;
  if (is_spoilt(TelegramFault::kCut)) fault.cut_after = kFaultAt;
  if (is_spoilt(TelegramFault::kWrongParity)) fault.wrong_parity = kFaultAt;
  uart_sender_->begin(cpu_.now(), std::vector<std::uint8_t>(bytes, bytes + n), fault);
  cpu_.transfer(*uart_sender_);
  return true;
}

std::uint16_t SerialPort::receive(std::uint8_t* bytes, std::size_t n, std::uint32_t timeout_us) {
  receiver_.begin(cpu_.now(), n, static_cast<Tick>(timeout_us) * bus::kTicksPerUs);
  cpu_.transfer(receiver_);
  const std::vector<std::uint8_t>& received = receiver_.received();
  std::copy(received.begin(), received.end(), bytes);
  return static_cast<std::uint16_t>(received.size());
}

}  // namespace dsdpv1::user_cpu

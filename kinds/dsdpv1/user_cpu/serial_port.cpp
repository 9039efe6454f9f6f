#include "kinds/dsdpv1/user_cpu/serial_port.hpp"

#include <algorithm>
#include <utility>

#include "driver/dsdpv1.h"

namespace dsdpv1::user_cpu {
namespace {

SerialPort& self(void* ctx) { return *static_cast<SerialPort*>(ctx); }

constexpr std::size_t kFaultAt = 2;         ///< the byte of a telegram that is disturbed
constexpr std::int64_t kTalkOverBits = 20;  ///< from a telegram's end into its reply, which has begun by then (UA4)

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

void SerialPort::spoil(TelegramFault fault, int times, Tick pause) {
  fault_ = fault;
  pause_ = pause;
  spoilt_ = times;
}

void SerialPort::telegram(std::vector<std::uint8_t> bytes, std::optional<int> listen) {
  constexpr int kUsual = 8;
  const std::uint16_t crc = dsdpv1_crc(DSDPV1_CRC_START, bytes.data(), bytes.size());
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
  bytes.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
  if (spi_master_) return telegram_over_spi(std::move(bytes), listen.value_or(kUsual));
  telegram_over_uart(bytes, listen);
}

void SerialPort::telegram_over_spi(std::vector<std::uint8_t> bytes, int listen) {
  bytes.resize(bytes.size() + static_cast<std::size_t>(listen), 0xFF);
  std::vector<std::uint8_t> received(bytes.size());
  frame(bytes.data(), received.data(), bytes.size());
}

/// A reply has ended when the chip's longest silence within a telegram and one and a half characters have passed.
void SerialPort::telegram_over_uart(const std::vector<std::uint8_t>& bytes, std::optional<int> listen) {
  constexpr Tick kHalfCharacterBits = 11, kMore = 3;
  constexpr std::size_t kLongest = 512;
  const auto& port = std::get<UartPort>(port_.port);
  send(bytes.data(), bytes.size());
  if (listen == 0) return;
  const Tick half_character = kHalfCharacterBits * bus::kTicksPerSecond / (2 * port.timing.baud);
  receiver_.begin(cpu_.now(), listen ? static_cast<std::size_t>(*listen) : kLongest,
                  (port.interval + kMore) * half_character);
  cpu_.transfer(receiver_);
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
  claims_.frame(bytes, master.received(), begun, cpu_.now());
  return true;
}

UartFault SerialPort::uart_fault() {
  UartFault fault;
  if (is_spoilt(TelegramFault::kFlippedBit)) fault.flipped_bit = 8 * kFaultAt;
  if (is_spoilt(TelegramFault::kCut)) fault.cut_after = kFaultAt;
  if (is_spoilt(TelegramFault::kWrongParity)) fault.wrong_parity = kFaultAt;
  if (is_spoilt(TelegramFault::kBreak)) fault.break_at = kFaultAt;
  if (is_spoilt(TelegramFault::kTalkOver)) fault.talk_over = kTalkOverBits * bus::kTicksPerSecond / uart_.baud;
  if (is_spoilt(TelegramFault::kPause)) {
    fault.pause_before = kFaultAt;
    fault.pause = pause_;
  }
  return fault;
}

bool SerialPort::send(const std::uint8_t* bytes, std::size_t n) {
  uart_sender_->begin(cpu_.now(), std::vector<std::uint8_t>(bytes, bytes + n), uart_fault());
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

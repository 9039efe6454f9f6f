#include "kinds/dsdpv1/user_cpu/process_user.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include "kinds/dsdpv1/user_cpu/orders.hpp"

namespace dsdpv1::user_cpu {
namespace {

static_assert(DSDPV1_BENCH_TICKS_PER_NS == bus::kTicksPerNs);

constexpr std::uint32_t kDpramCells = 0x800, kMostBytes = 1024;

/// `ticks` from now on, at most the end of time.
Tick end_of(Tick now, std::uint64_t ticks) {
  return now + static_cast<Tick>(std::min<std::uint64_t>(ticks, static_cast<std::uint64_t>(bus::kNever - now)));
}

}  // namespace

ProcessUser::ProcessUser(HostBus& bus, const CpuTiming& timing, ProcessOptions options, Tick start,
                         const HostPort& port)
    : bus_(bus),
      options_(std::move(options)),
      port_(port),
      acts_(start),
      cpu_(
          bus, timing, [this](Cpu& cpu) { serve(cpu); }, start) {
  cpu_.on_announce = [this] {
    announce();
    if (on_plan) on_plan();
  };
}

void ProcessUser::command(Tick /*now*/, const Command& command) { (void)user_cpu::carry_out(command, bus_); }

UserCounters ProcessUser::counters() const {
  return {serial_ ? serial_->counters() : handshake_.counters(), std::nullopt, cpu_.counters()};
}

void ProcessUser::serve(Cpu& cpu) {
  try {
    child_ = std::make_unique<ChildProcess>(options_.arguments, DSDPV1_BENCH_VARIABLE);
  } catch (const std::system_error& error) {
    return fail(fmt::format("cannot be started: {}", error.code().message()));
  }
  if (!std::holds_alternative<std::monostate>(port_.port)) serial_ = std::make_unique<SerialPort>(cpu, port_);
  while (serve_one(cpu)) {
  }
}

/// The program cannot go on; its chip does.
void ProcessUser::fail(const std::string& why) {
  const std::string name = std::filesystem::path(options_.arguments[0]).filename().string();
  const std::optional<std::uint32_t> last = std::exchange(present_, std::nullopt);
  const std::optional<Place> place = last && options_.lines_of ? std::optional(place_of(*last)) : std::nullopt;
  if (on_error) on_error({cpu_.now(), kProcessEnded, fmt::format("{} {}", name, why), place});
}

// ------------------------------------------------------------------------------------------------------------- places

std::optional<Place> ProcessUser::where(const Act& act) const {
  if (!options_.lines_of) return std::nullopt;
  for (const Look& look : looks_)
    if (act.look && act.at == look.at) return place_of(look.callers);
  if (act.since && present_) acts_.sample(act.at, *present_, *present_);
  return acts_.where(act, [this](std::uint32_t callers) { return place_of(callers); });
}

const Place& ProcessUser::place_of(std::uint32_t callers) const {
  if (!lines_) lines_ = options_.lines_of(program_);
  return callers_.place(callers, lines_);
}

/// What moves the chip's pins, or looks at them.
void ProcessUser::note_act(Tick now, const Request& request) {
  if (!present_) return;
  const std::uint32_t from = *present_;
  switch (request.what) {
    case DSDPV1_BENCH_READ: return acts_.access(now, from, request.address, 1, false);
    case DSDPV1_BENCH_WRITE: return acts_.access(now, from, request.address, 1, true);
    case DSDPV1_BENCH_R_REQ:
    case DSDPV1_BENCH_R_STA: return acts_.pins(now, from, request.value == 0);
    case DSDPV1_BENCH_L_REQ: looks_[0] = {now, from}; return;
    case DSDPV1_BENCH_L_STA: looks_[1] = {now, from}; return;
    case DSDPV1_BENCH_EXCHANGE:
    case DSDPV1_BENCH_SEND: return acts_.pins(now, from, false);
    default: return;
  }
}

// ----------------------------------------------------------------------------------------------------------- requests

/// False: the program has ended.
bool ProcessUser::receive_callers(const Request& request) {
  present_.reset();
  addresses_.resize(std::min(request.callers, DSDPV1_BENCH_CALLERS));
  if (addresses_.empty()) return true;
  if (!receive(addresses_.data(), addresses_.size() * sizeof addresses_[0])) return false;
  own_addresses_.clear();
  for (const std::uint64_t address : addresses_)
    if (address - load_address_ <= std::numeric_limits<std::uint32_t>::max())
      own_addresses_.push_back(static_cast<std::uint32_t>(address - load_address_));
  if (!own_addresses_.empty()) present_ = callers_.number(own_addresses_);
  return true;
}

/// The first request. False: the program has another version of the wire.
bool ProcessUser::begin(const Request& request) {
  const bool says_hello = request.what == DSDPV1_BENCH_HELLO;
  if (!says_hello || request.value != DSDPV1_BENCH_VERSION) {
    fail(fmt::format("has version {} of dsdpv1_bench_wire.h, expected {}: compile it with this dsdpv1_bench.c",
                     says_hello ? request.value : 0, DSDPV1_BENCH_VERSION));
    return false;
  }
  load_address_ = request.ticks;
  program_ = child_->program().string();
  if (program_.empty()) program_ = options_.arguments[0];
  return true;
}

/// Returns false at the program's end.
bool ProcessUser::serve_one(Cpu& cpu) {
  Request request{};
  if (!receive(&request, sizeof request)) return false;
  if (!program_.empty() ? !receive_callers(request) : !begin(request)) return false;
  bytes_.resize(std::min(request.length, kMostBytes));
  if (!bytes_.empty() && !receive(bytes_.data(), bytes_.size())) return false;
  Answer answer{};
  note_act(cpu.now(), request);
  if (!carry_out(cpu, request, answer)) {
    fail(fmt::format("has made a request that this port does not have ({}, address {:X}, length {})", request.what,
                     request.address, request.length));
    return false;
  }
  answer.intr0 = answer.intr0 != 0 || cpu.wait_intr0(cpu.now()) ? 1 : 0;
  if (answer.intr0 != 0) cpu.wait(cpu.timing().interrupt_latency);
  if (present_) acts_.sample(cpu.now(), *present_, *present_);
  answer.now = static_cast<std::uint64_t>(cpu.now());
  child_->send(&answer, sizeof answer);
  if (answer.length != 0) child_->send(bytes_.data(), answer.length);
  return true;
}

bool ProcessUser::receive(void* bytes, std::size_t n) {
  const ChildProcess::Got got = child_->receive(bytes, n, options_.patience_ms);
  child_->lines([this](const std::string& line) {
    if (on_text) on_text(cpu_.now(), line);
  });
  if (got == ChildProcess::Got::kAll) return true;
  if (got == ChildProcess::Got::kLate)
    fail(
        fmt::format("has not called its port for {:g} s of the host's time: a loop without a call of it? "
                    "(user_cpu: {{patience: ...}})",
                    options_.patience_ms / 1000.0));
  if (got == ChildProcess::Got::kEnd) fail(child_->ending());
  return false;
}

/// False: a request that does not exist, or not with this port.
bool ProcessUser::carry_out(Cpu& cpu, const Request& request, Answer& answer) {
  const bool level = request.value != 0;
  if (request.address >= kDpramCells || request.length > kMostBytes) return false;
  switch (request.what) {
    case DSDPV1_BENCH_HELLO: return true;
    case DSDPV1_BENCH_READ: answer.value = cpu.read(static_cast<std::uint16_t>(request.address)); return true;
    case DSDPV1_BENCH_WRITE:
      cpu.write(static_cast<std::uint16_t>(request.address), static_cast<std::uint8_t>(request.value));
      return true;
    case DSDPV1_BENCH_R_REQ:
      handshake_.r_req(cpu.now(), level);
      cpu.set_r_req(level);
      return true;
    case DSDPV1_BENCH_R_STA:
      handshake_.r_sta(cpu.now(), level);
      cpu.set_r_sta(level);
      return true;
    case DSDPV1_BENCH_L_REQ: answer.value = cpu.l_req() ? 1 : 0; return true;
    case DSDPV1_BENCH_L_STA: answer.value = cpu.l_sta() ? 1 : 0; return true;
    case DSDPV1_BENCH_WAIT: {
      const Tick until = end_of(cpu.now(), request.ticks);
      if (level)
        answer.intr0 = cpu.wait_intr0(until) ? 1 : 0;
      else
        cpu.wait_until(until);
      return true;
    }
    default: return serial_ && transfer(request, answer);
  }
}

bool ProcessUser::transfer(const Request& request, Answer& answer) {
  const bool spi = std::holds_alternative<SpiPort>(port_.port);
  switch (request.what) {
    case DSDPV1_BENCH_EXCHANGE:
      if (!spi || bytes_.empty()) return false;
      serial_->frame(bytes_.data(), bytes_.data(), bytes_.size());
      answer.length = request.length;
      return true;
    case DSDPV1_BENCH_SEND:
      if (spi || bytes_.empty()) return false;
      serial_->send(bytes_.data(), bytes_.size());
      return true;
    case DSDPV1_BENCH_RECEIVE: {
      if (spi || request.value > kMostBytes) return false;
      bytes_.resize(request.value);
      const auto timeout_us = static_cast<std::uint32_t>(request.ticks / static_cast<std::uint64_t>(bus::kTicksPerUs));
      answer.length = serial_->receive(bytes_.data(), bytes_.size(), timeout_us);
      return true;
    }
    default: return false;
  }
}

}  // namespace dsdpv1::user_cpu

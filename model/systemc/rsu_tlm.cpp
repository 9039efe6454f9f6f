#include "model/systemc/rsu_tlm.hpp"

#include "model/systemc/has_process.hpp"

#include <string>
#include <utility>

namespace dsdpv1::systemc {
namespace {

RsuTlmOptions of_rsu(RsuTlmOptions options) {
  options.chip.part = Part::kRsu;
  return options;
}

constexpr int kLongestSeries = 1'000'000;  // bits: their ticks stay within 64 bits

}  // namespace

RsuTlmModule::RsuTlmModule(const sc_core::sc_module_name& name, const RsuTlmOptions& options)
    : TlmModule(name, of_rsu(options)),
      straps_(options.straps),
      spi_timing_(options.spi),
      uart_timing_(options.uart),
      select_(options.spi) {
  spi_socket.register_b_transport(this, &RsuTlmModule::transport_spi);
  spi_socket.register_transport_dbg(this, &RsuTlmModule::transport_dbg);
  uart_socket.register_b_transport(this, &RsuTlmModule::transport_uart);
  uart_socket.register_transport_dbg(this, &RsuTlmModule::transport_dbg);
  uart_in.bind(uart_input_);
  DSDPV1_HAS_PROCESS(RsuTlmModule);
  SC_METHOD(select);
  sensitive << XSS;
  const struct {
    Pin pin;
    int level;
  } straps[] = {{Pin::kMode, static_cast<int>(straps_.mode)},
                {Pin::kAdr, straps_.address},
                {Pin::kUbr, straps_.uart_rate},
                {Pin::kUiv, straps_.interval}};
  for (const auto& strap : straps) {
    const int most = (1 << width(strap.pin)) - 1;
    if (strap.level < 0 || strap.level > most) {
      const std::string text = std::string(this->name()) + ": the strap " + dsdpv1::name(strap.pin) + " is " +
                               std::to_string(strap.level) + ", expected 0 to " + std::to_string(most);
      SC_REPORT_ERROR("/dsdpv1/straps", text.c_str());
    }
    set(0, strap.pin, static_cast<Level>(strap.level));
  }
}

void RsuTlmModule::check_binding() {
  switch (straps_.mode) {
    case HostMode::kParallel: return require_host_bound("the straps choose the parallel port");
    case HostMode::kSpi: return require_bound(spi_socket, "the straps choose SPI");
    case HostMode::kUart: return require_bound(uart_socket, "the straps choose the UART");
  }
}

// ------------------------------------------------------------------------------------------------- host to chip

void RsuTlmModule::transport_spi(Payload& payload, sc_core::sc_time& delay) {
  payload.set_dmi_allowed(false);
  payload.set_response_status(judge_stream(payload));
  if (!payload.is_response_ok()) return;
  wait_for(delay);
  const sc_core::sc_scoped_lock turn(spi_bus_);
  selects_by_line() ? transfer_bytes(payload) : transfer_frame(payload);
  const std::vector<std::uint8_t>& received = spi_.edges.received();
  if (payload.is_read()) std::copy(received.begin(), received.end(), payload.get_data_ptr());
}

void RsuTlmModule::transfer_frame(Payload& payload) {
  SpiFrame frame = frame_of(payload, spi_timing_);
  const Tick begin = std::max(earliest(), spi_free_at_);
  spi_free_at_ = begin + frame.duration() + gap_of(payload, spi_timing_);
  try {
    carry_out(spi_, std::move(frame), begin);
  } catch (...) {
    release({{Pin::kXss, 1}, {Pin::kSck, 0}, {Pin::kMosi, 0}});
    spi_free_at_ = 0;
    throw;
  }
}

/// The signal of XSS needs a delta cycle if the controller has written it just now.
void RsuTlmModule::transfer_bytes(Payload& payload) {
  wait(sc_core::SC_ZERO_TIME);
  select();
  SpiFrame clocks = clocks_of(payload, spi_timing_);
  const Tick at = chip_tick(earliest()), begin = earliest() + select_.begin(at) - at, end = begin + clocks.duration();
  select_.clocks_end(chip_tick(end));
  try {
    carry_out(spi_, std::move(clocks), begin);
  } catch (...) {
    release({{Pin::kSck, 0}, {Pin::kMosi, 0}});
    select_.clocks_end(chip_now());
    throw;
  }
}

void RsuTlmModule::set_xss(bool level) {
  by_line_ = true;
  move_xss(level);
}

void RsuTlmModule::select() {
  if (XSS.size() > 0) move_xss(XSS->read());
}

void RsuTlmModule::move_xss(bool level) {
  if (level == select_.level()) return;
  select_.move(chip_now(), level, spi_.is_busy());
  catch_up();
  plan();
}

void RsuTlmModule::transport_uart(Payload& payload, sc_core::sc_time& delay) {
  payload.set_dmi_allowed(false);
  payload.set_response_status(payload.is_read() ? tlm::TLM_COMMAND_ERROR_RESPONSE : judge_stream(payload));
  if (!payload.is_response_ok()) return;
  wait_for(delay);
  const sc_core::sc_scoped_lock turn(uart_bus_);
  try {
    carry_out(uart_, telegram_of(payload, uart_timing_), earliest());
  } catch (...) {
    uart_ = {};
    rxd_lane_ = true;
    try_to([this] { set_rxd(chip_now()); });
    plan();
    throw;
  }
}

template <class Edges>
void RsuTlmModule::carry_out(Lane<Edges>& lane, Edges edges, Tick begin) {
  wait_until(begin);
  lane = {std::move(edges), 0, chip_tick(begin)};
  thrown_ = nullptr;  // of one that was killed
  catch_up();         // start with the core at the present time
  wait_until(begin + lane.edges.duration());
  plan();
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

/// The module's own process moves the pins. An exception of an observer leaves through the transaction, if there is
/// one.
void RsuTlmModule::move_host(Tick now) {
  const bool in_transaction = spi_.is_busy() || uart_.is_busy();
  try {
    move_pins(now);
  } catch (...) {
    if (!in_transaction) throw;
    thrown_ = std::current_exception();
  }
}

/// Each edge is an event of the kernel, so those up to `now` are at `now`, in any order of the two ports.
void RsuTlmModule::move_pins(Tick now) {
  while (select_.next() <= now) {
    const Edge edge = select_.take();
    set(edge.at, Pin::kXss, edge.level ? 1 : 0);
  }
  while (spi_.next() <= now) {
    const SerialEdge edge = spi_.edges[spi_.moved++];
    const Tick at = spi_.begin + edge.at;
    if (edge.pin == Pin::kMiso)
      spi_.edges.sampled(miso_before(at) != 0);  // released, it reads high: a board has a pull-up
    else if (edge.pin != Pin::kXss || !selects_by_line())
      set(at, edge.pin, edge.level ? 1 : 0);
  }
  while (uart_.next() <= now) {
    const Tick at = uart_.next();
    rxd_lane_ = uart_.edges[uart_.moved++].level;
    set_rxd(at);
  }
  while (to_uart_.next() <= now) {
    const Edge edge = to_uart_.take();
    rxd_character_ = edge.level;
    set_rxd(edge.at);
  }
}

void RsuTlmModule::set_rxd(Tick at) { set(at, Pin::kRxd, rxd_lane_ && rxd_character_ ? 1 : 0); }

/// Ends a frame or the clocks at once, because the initiator's process was reset or killed, or an observer has thrown:
/// the pins idle, whatever observers throw now.
void RsuTlmModule::release(std::initializer_list<PinLevel> pins) {
  try_to([this] { catch_up(); });
  spi_ = {};
  try_to([&] { set_all(chip_now(), pins); });
  plan();
}

void RsuTlmModule::send(const BusCharacter& character) {
  const Tick now = chip_now(), begin = std::max({now, chip_tick(to_tick(character.start)), to_uart_end_});
  const std::uint16_t frame = dsdpv1::systemc::frame_of(character.data, character.parity_ok, character.stop_ok);
  if (begin != to_uart_end_ || character.bit != series_.bit || series_.bits > kLongestSeries)
    series_ = {begin, 0, character.bit};
  const auto tick_of_bit = [this](int bit) {
    const int count = series_.bits + bit;
    const bool own = series_.bit == sc_core::SC_ZERO_TIME;
    return series_.begin + (own ? half_bits(uart_timing_, 2 * count) : to_tick(count * series_.bit));
  };
  bool level = true;
  for (int bit = 0; bit < profibus::kBitsPerCharacter; ++bit)
    if (const bool before = std::exchange(level, (frame >> bit & 1U) != 0); level != before)
      to_uart_.push({tick_of_bit(bit), level});
  to_uart_end_ = tick_of_bit(profibus::kBitsPerCharacter);
  series_.bits += profibus::kBitsPerCharacter;
  if (!level) to_uart_.push({to_uart_end_, true});
  begins_.erase(begins_.begin(), std::upper_bound(begins_.begin(), begins_.end(), now));
  begins_.push_back(begin);
  uart_idle_.cancel();
  uart_idle_.notify(time_until(to_uart_end_ + zero()));
  catch_up();
  plan();
}

std::size_t RsuTlmModule::uart_waiting() const {
  return static_cast<std::size_t>(begins_.end() - std::upper_bound(begins_.begin(), begins_.end(), chip_now()));
}

// ------------------------------------------------------------------------------------------------- save and restore

/// Transactions are over.
template <class Archive>
void RsuTlmModule::store(Archive& archive) {
  archive(from_uart_, select_, by_line_, to_uart_, rxd_lane_, rxd_character_, series_.bits);
  archive.ticks(to_uart_end_, series_.begin);
  store_list(archive, begins_);
  store_duration(archive, series_.bit);
  store_time(archive, spi_free_at_);
}

void RsuTlmModule::store_module(profibus::StateWriter& archive) {
  TlmModule::store_module(archive);
  store(archive);
}

void RsuTlmModule::store_module(profibus::StateReader& archive) {
  TlmModule::store_module(archive);
  store(archive);
  spi_ = {};
  uart_ = {};
  uart_idle_.cancel();
  if (to_uart_end_ > chip_now()) uart_idle_.notify(time_until(to_uart_end_ + zero()));
}

// ------------------------------------------------------------------------------------------------- chip to host

bool RsuTlmModule::output_changed(Tick at, Pin pin, Level level) {
  if (pin != Pin::kTxd) return TlmModule::output_changed(at, pin, level);
  others_changed();
  collect_byte(at);
  const auto rate = static_cast<std::size_t>(straps_.uart_rate);
  from_uart_.edge(at, level != 0, kUbrCycles.at(rate) * profibus::kTicksPerCycle);
  return hears(pin);
}

void RsuTlmModule::collect_byte(Tick now) {
  if (const auto character = from_uart_.take(now)) received_.push_back(*character);
}

void RsuTlmModule::tell_host(Tick now) {
  collect_byte(now);
  while (!received_.empty()) {  // a listener may call back and continue here
    const LineCharacter character = received_.front();
    received_.pop_front();
    if (character.parity_ok && character.stop_ok) uart_out.write(character.data);
    uart_characters.write(on_bus(character, zero()));
  }
}

}  // namespace dsdpv1::systemc

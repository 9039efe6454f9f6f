#include "model/systemc/rsu_tlm.hpp"

#include <string>
#include <utility>

namespace dsdpv1::systemc {
namespace {

RsuTlmOptions of_rsu(RsuTlmOptions options) {
  options.chip.part = Part::kRsu;
  return options;
}

}  // namespace

RsuTlmModule::RsuTlmModule(const sc_core::sc_module_name& name, const RsuTlmOptions& options)
    : TlmModule(name, of_rsu(options)), straps_(options.straps), spi_timing_(options.spi), uart_timing_(options.uart) {
  spi_socket.register_b_transport(this, &RsuTlmModule::transport_spi);
  spi_socket.register_transport_dbg(this, &RsuTlmModule::transport_dbg);
  uart_socket.register_b_transport(this, &RsuTlmModule::transport_uart);
  uart_socket.register_transport_dbg(this, &RsuTlmModule::transport_dbg);
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
  SpiFrame frame = frame_of(payload, spi_timing_);
  const Tick begin = std::max(earliest(), spi_free_at_);
  spi_free_at_ = begin + frame.duration() + gap_of(payload, spi_timing_);
  try {
    carry_out(spi_, std::move(frame), begin);
  } catch (...) {
    release({Pin::kXss, Pin::kSck, Pin::kMosi});
    spi_free_at_ = 0;
    throw;
  }
  const std::vector<std::uint8_t>& received = spi_.edges.received();
  if (payload.is_read()) std::copy(received.begin(), received.end(), payload.get_data_ptr());
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
    release({Pin::kRxd});
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

/// The module's own process moves the pins. An exception of an observer leaves through the transaction.
void RsuTlmModule::move_host(Tick now) {
  try {
    move_pins(now);
  } catch (...) {
    thrown_ = std::current_exception();
  }
}

/// Each edge is an event of the kernel, so those up to `now` are at `now`, in any order of the two ports.
void RsuTlmModule::move_pins(Tick now) {
  while (spi_.next() <= now) {
    const SerialEdge edge = spi_.edges[spi_.moved++];
    const Tick at = spi_.begin + edge.at;
    if (edge.pin == Pin::kMiso)
      spi_.edges.sampled(miso_before(at) != 0);  // released, it reads high: a board has a pull-up
    else
      set(at, edge.pin, edge.level ? 1 : 0);
  }
  for (; uart_.next() <= now; ++uart_.moved) set(uart_.next(), Pin::kRxd, uart_.edges[uart_.moved].level ? 1 : 0);
}

/// Ends a transaction at once, because its initiator's process was reset or killed: the pins idle.
void RsuTlmModule::release(std::initializer_list<Pin> pins) {
  catch_up();
  for (const Pin pin : pins) {
    if (pin == Pin::kXss) spi_ = {};
    if (pin == Pin::kRxd) uart_ = {};
    set(chip_now(), pin, pin == Pin::kXss || pin == Pin::kRxd ? 1 : 0);
  }
  plan();
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
  const auto character = from_uart_.take(now);
  if (character && character->parity_ok && character->stop_ok) received_.push_back(character->data);
}

void RsuTlmModule::tell_host(Tick now) {
  collect_byte(now);
  for (const std::uint8_t byte : std::exchange(received_, {})) uart_out.write(byte);
}

}  // namespace dsdpv1::systemc

#include "model/systemc/spi_pins.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "model/systemc/has_process.hpp"
#include "model/systemc/transaction.hpp"

namespace dsdpv1::systemc {

SpiPins::SpiPins(const sc_core::sc_module_name& name, const SpiTiming& timing)
    : sc_module(name), timing_(timing), select_(timing) {
  require_resolution();
  socket.register_b_transport(this, &SpiPins::b_transport);
  XSS.initialize(true);
  DSDPV1_HAS_PROCESS(SpiPins);
  SC_METHOD(play);  // the only process that writes the pins, for all initiators
  sensitive << due_ << soon_ << CS;
}

void SpiPins::b_transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
  payload.set_dmi_allowed(false);
  payload.set_response_status(judge_stream(payload));
  if (!payload.is_response_ok()) return;
  wait_for(delay);
  const sc_core::sc_scoped_lock turn(bus_);
  while (is_busy()) wait(end_);  // the transaction of a killed initiator is still running
  if (selects_by_line()) {
    wait(sc_core::SC_ZERO_TIME);  // the controller may have written CS just now
    select();
    SpiFrame clocks = clocks_of(payload, timing_);
    const Tick begin = select_.begin(current_tick());
    select_.clocks_end(begin + clocks.duration());
    carry_out(std::move(clocks), begin);
  } else {
    SpiFrame frame = frame_of(payload, timing_);
    const Tick begin = std::max(current_tick(), free_at_);
    free_at_ = begin + frame.duration() + gap_of(payload, timing_);
    carry_out(std::move(frame), begin);
  }
  const std::vector<std::uint8_t>& received = frame_.received();
  if (payload.is_read()) std::copy(received.begin(), received.end(), payload.get_data_ptr());
}

void SpiPins::carry_out(SpiFrame frame, Tick begin) {
  frame_ = std::move(frame);
  moved_ = 0;
  begin_ = begin;
  soon_.notify(sc_core::SC_ZERO_TIME);
  while (is_busy()) wait(end_);
}

void SpiPins::set_cs(bool level) {
  by_line_ = true;
  select_.move(current_tick(), level, is_busy());
  soon_.notify(sc_core::SC_ZERO_TIME);
}

void SpiPins::select() {
  if (CS.size() > 0) select_.move(current_tick(), CS->read(), is_busy());
}

void SpiPins::play() {
  select();
  const Tick now = current_tick();
  while (select_.next() <= now) XSS.write(select_.take().level);
  const bool was_busy = is_busy();
  while (next_edge() <= now) move(frame_[moved_++]);
  if (was_busy && !is_busy()) end_.notify(sc_core::SC_ZERO_TIME);
  const Tick next = std::min(select_.next(), next_edge());
  if (next == profibus::kNever) return;
  due_.cancel();  // a later one
  due_.notify(time_until(next));
}

void SpiPins::move(const SerialEdge& edge) {
  switch (edge.pin) {
    case Pin::kMiso: return frame_.sampled(MISO.read() != sc_dt::SC_LOGIC_0);  // a board has a pull-up
    case Pin::kSck: return SCK.write(edge.level);
    case Pin::kMosi: return MOSI.write(edge.level);
    default:
      if (!selects_by_line()) XSS.write(edge.level);
  }
}

}  // namespace dsdpv1::systemc

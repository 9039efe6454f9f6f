// Class 1: slaves, their data, requests out of the cycle.
#include <algorithm>

#include "capi/master.hpp"
#include "capi/names.hpp"
#include "capi/sized.hpp"
#include "capi/slave.hpp"
#include "capi/telegram.hpp"

using capi::class_1_of;
using capi::fail;
using capi::guarded;
using capi::need;

namespace dsdpv1::capi {

void need_slave(const bus::Master1& master, std::uint8_t address) {
  const std::vector<std::uint8_t> all = master.slave_addresses();
  if (std::find(all.begin(), all.end(), address) == all.end())
    fail(DPSIM_ERR_NOT_FOUND, "the master has no slave with the address " + std::to_string(address));
}

namespace {

void tell_data(const dpsim_master& master, dpsim_event_type type, bus::Tick at, std::uint8_t address,
               const bus::Bytes& data) {
  dpsim_event event = master.event(type, at);
  event.address = address;
  event.data = data.data();
  event.data_size = static_cast<std::uint32_t>(data.size());
  master.bus.tell(event);
}

}  // namespace

void connect(dpsim_master& master, bus::Master1& own) {
  own.on_state = [&master, &own](bus::Tick at, std::uint8_t address, bus::SlaveState from, bus::SlaveState to) {
    dpsim_event event = master.event(DPSIM_EVENT_SLAVE_STATE, at);
    event.address = address;
    event.from = static_cast<std::int32_t>(from);
    event.to = static_cast<std::int32_t>(to);
    event.text = own.slave(address).step_reason.c_str();
    master.bus.tell(event);
  };
  own.on_inputs = [&master, &own](bus::Tick at, std::uint8_t address) {
    tell_data(master, DPSIM_EVENT_INPUTS, at, address, own.slave(address).inputs);
  };
  own.on_diagnosis = [&master, &own](bus::Tick at, std::uint8_t address) {
    tell_data(master, DPSIM_EVENT_DIAGNOSIS, at, address, own.slave(address).diagnosis);
  };
  if (own.ring() != nullptr) connect(master, *own.ring());
}

}  // namespace dsdpv1::capi

namespace {

bus::AnswerCallback request_done(dpsim_master& master, std::uint32_t id, std::uint8_t address) {
  return [&master, id, address](const bus::FdlResult& result) {
    dpsim_event event = master.event(DPSIM_EVENT_REQUEST_DONE, master.bus.timeline.now());
    event.id = id;
    event.address = address;
    event.outcome = static_cast<std::int32_t>(result.outcome);
    event.data = result.raw.data();
    event.data_size = static_cast<std::uint32_t>(result.raw.size());
    master.bus.tell(event);
  };
}

void check_address(std::uint8_t address, int highest) { capi::need_range("address", address, 0, highest); }

dpsim_slave_status status_of(const bus::SlaveView& view) {
  dpsim_slave_status status{};
  status.state = static_cast<dpsim_slave_state>(view.state);
  status.reason = view.reason.c_str();
  status.inputs = view.inputs.data();
  status.outputs = view.outputs.data();
  status.diagnosis = view.diagnosis.data();
  status.input_count = static_cast<std::uint32_t>(view.inputs.size());
  status.output_count = static_cast<std::uint32_t>(view.outputs.size());
  status.diagnosis_count = static_cast<std::uint32_t>(view.diagnosis.size());
  status.data_exchanges = view.counters.data_exchanges;
  status.diagnoses = view.counters.diagnoses;
  status.parameterisations = view.counters.parameterisations;
  status.retries = view.counters.retries;
  status.timeouts = view.counters.timeouts;
  status.errors = view.counters.errors;
  status.refusals = view.counters.refusals;
  return status;
}

bus::WireFaults faults_of(const dpsim_wire_faults* given) {
  const dpsim_wire_faults own = capi::options_of(given, "faults");
  bus::WireFaults faults;
  if ((own.which & DPSIM_FAULT_PARITY) != 0) faults.wrong_parity_at = own.wrong_parity_at;
  if ((own.which & DPSIM_FAULT_STOP) != 0) faults.missing_stop_at = own.missing_stop_at;
  if ((own.which & DPSIM_FAULT_GAP) != 0) faults.gap_before = own.gap_before;
  capi::need_range("gap_millibits", own.gap_millibits, 0, 1'000'000);
  faults.gap_millibits = own.gap_millibits;
  if ((own.which & DPSIM_FAULT_TRUNCATE) != 0) faults.truncate_after = own.truncate_after;
  capi::need_range("truncate_bits", own.truncate_bits, 0, bus::kCharacterBits - 1);
  faults.truncate_bits = own.truncate_bits;
  if ((own.which & DPSIM_FAULT_GLITCH) != 0) faults.glitch_at = own.glitch_at;
  capi::need_range("glitch_start_millibits", own.glitch_start_millibits, 0, 11'000);
  capi::need_range("glitch_length_millibits", own.glitch_length_millibits, 0, 11'000);
  faults.glitch = {own.glitch_start_millibits, own.glitch_length_millibits};
  return faults;
}

void ask(bus::Master1& master, dpsim_service service, std::uint8_t address, const bus::AnswerCallback& done) {
  switch (service) {
    case DPSIM_SERVICE_FDL_STATUS: return master.fdl_status(address, done);
    case DPSIM_SERVICE_READ_INPUTS: return master.read_inputs(address, done);
    case DPSIM_SERVICE_READ_OUTPUTS: return master.read_outputs(address, done);
    case DPSIM_SERVICE_GET_CFG: return master.get_cfg(address, done);
    case DPSIM_SERVICE_SLAVE_DIAG: return master.slave_diag(address, done);
    default: fail(DPSIM_ERR_ARGUMENT, "service is " + std::to_string(service) + ", expected 0, 56, 57, 59, 60");
  }
}

}  // namespace

dpsim_status dpsim_master_add_slave(dpsim_master* master, const dpsim_slave* slave) {
  return guarded(
      __func__,
      [&] {
        bus::Master1& own = class_1_of(master);
        need(slave, "slave");
        const bus::SlaveParameters parameters = capi::parameters_of(*slave);
        own.add_slave(parameters);
        own.set_outputs(parameters.address, bus::Bytes(static_cast<std::size_t>(parameters.output_length)));
      });
}

dpsim_status dpsim_master_set_clear(dpsim_master* master, int32_t clear) {
  return guarded(
      __func__,
      [&] {
        bus::Master1& own = class_1_of(master);
        if (clear != 0)
          own.clear();
        else
          own.operate();
      });
}

dpsim_status dpsim_master_set_outputs(dpsim_master* master, uint8_t address, const uint8_t* data, size_t count) {
  return guarded(
      __func__,
      [&] {
        bus::Master1& own = class_1_of(master);
        capi::need_slave(own, address);
        own.set_outputs(address, capi::bytes_of(data, count));
      });
}

dpsim_status dpsim_master_release(dpsim_master* master, uint8_t address) {
  return guarded(
      __func__,
      [&] {
        bus::Master1& own = class_1_of(master);
        capi::need_slave(own, address);
        own.release(address);
      });
}

dpsim_status dpsim_master_activate(dpsim_master* master, uint8_t address) {
  return guarded(
      __func__,
      [&] {
        bus::Master1& own = class_1_of(master);
        capi::need_slave(own, address);
        own.activate(address);
      });
}

dpsim_status dpsim_master_get_slave(const dpsim_master* master, uint8_t address, dpsim_slave_status* status) {
  return guarded(
      __func__,
      [&] {
        const bus::Master1& own = class_1_of(master);
        capi::need_slave(own, address);
        capi::give(status_of(own.slave(address)), status, "status");
      });
}

dpsim_status dpsim_master_get_status(const dpsim_master* master, dpsim_master_status* status) {
  return guarded(
      __func__,
      [&] {
        const bus::Master1& own = class_1_of(master);
        dpsim_master_status filled{};
        filled.running = own.running() ? 1 : 0;
        filled.clear = own.clearing() ? 1 : 0;
        filled.cycles = own.cycles();
        filled.cycle_time = static_cast<std::uint64_t>(own.cycle_time());
        capi::give(filled, status, "status");
      });
}

dpsim_status dpsim_master_ask(dpsim_master* master, dpsim_service service, uint8_t address, uint32_t* id) {
  return guarded(
      __func__,
      [&] {
        bus::Master1& own = class_1_of(master);
        check_address(address, bus::kHighestAddress);
        capi::numbered(
            *master, id,
            [&](std::uint32_t number) { ask(own, service, address, request_done(*master, number, address)); });
      });
}

dpsim_status dpsim_master_global_control(dpsim_master* master, uint8_t command, uint8_t group, uint8_t address,
                                         uint32_t* id) {
  return guarded(
      __func__,
      [&] {
        bus::Master1& own = class_1_of(master);
        check_address(address, bus::kBroadcast);
        capi::numbered(
            *master, id,
            [&](std::uint32_t number) {
              own.global_control(command, group, address, request_done(*master, number, address));
            });
      });
}

dpsim_status dpsim_master_set_slave_address(dpsim_master* master, uint8_t address, uint8_t new_address, uint16_t ident,
                                            int32_t lock, uint32_t* id) {
  return guarded(
      __func__,
      [&] {
        bus::Master1& own = class_1_of(master);
        check_address(address, bus::kHighestAddress);
        capi::numbered(
            *master, id,
            [&](std::uint32_t number) {
              own.set_slave_address(address, new_address, ident, lock != 0, request_done(*master, number, address));
            });
      });
}

dpsim_status dpsim_master_request(dpsim_master* master, const dpsim_telegram* telegram, uint32_t* id) {
  return guarded(
      __func__,
      [&] {
        bus::Master1& own = class_1_of(master);
        need(telegram, "telegram");
        bus::Telegram request = capi::telegram_of(*telegram);
        request.sa = master->address;
        bus::encode(request);
        capi::numbered(
            *master, id,
            [&](std::uint32_t number) { own.request(request, request_done(*master, number, request.da)); });
      });
}

dpsim_status dpsim_master_send_raw(dpsim_master* master, const uint8_t* bytes, size_t count,
                                   const dpsim_wire_faults* faults, int32_t wants_answer, uint32_t* id) {
  return guarded(
      __func__,
      [&] {
        bus::Master1& own = class_1_of(master);
        capi::need_range("count", static_cast<long long>(count), 1, DPSIM_MAX_TELEGRAM);
        const bus::Bytes raw = capi::bytes_of(bytes, count);
        const bus::WireFaults broken = faults_of(faults);
        capi::numbered(
            *master, id,
            [&](std::uint32_t number) {
              own.send_raw(raw, broken, wants_answer != 0, request_done(*master, number, 255));
            });
      });
}

// Class 2: connections; and acyclic requests of both classes.
#include "capi/master.hpp"
#include "capi/names.hpp"
#include "capi/sized.hpp"

using capi::class_2_of;
using capi::guarded;

namespace dsdpv1::capi {
namespace {

std::uint32_t codes_of(unsigned high, unsigned middle, unsigned low) { return high << 16U | middle << 8U | low; }

std::uint32_t codes_of(const bus::ConnectionEnd& end) {
  return end.by == bus::ConnectionEnd::By::kRefused ? codes_of(end.error_decode, end.error_code_1, end.error_code_2)
                                                    : codes_of(end.subnet, end.instance_and_reason, end.detail);
}

}  // namespace

void need_connection(const bus::Master2& master, std::uint32_t connection) {
  if (connection >= master.connections())
    fail(DPSIM_ERR_NOT_FOUND, "the master has no connection " + std::to_string(connection) + ", it has " +
                                  std::to_string(master.connections()));
}

void connect(dpsim_master& master, bus::Master2& own) {
  own.on_state = [&master, &own](bus::Tick at, bus::ConnectionId id, bus::ConnectionState from,
                                 bus::ConnectionState to) {
    dpsim_event event = master.event(DPSIM_EVENT_CONNECTION_STATE, at);
    event.id = static_cast<std::uint32_t>(id);
    event.address = own.connection(id).parameters().slave;
    event.from = static_cast<std::int32_t>(from);
    event.to = static_cast<std::int32_t>(to);
    master.bus.tell(event);
  };
  own.on_end = [&master, &own](bus::Tick at, bus::ConnectionId id, const bus::ConnectionEnd& end) {
    dpsim_event event = master.event(DPSIM_EVENT_CONNECTION_END, at);
    event.id = static_cast<std::uint32_t>(id);
    event.address = own.connection(id).parameters().slave;
    event.outcome = static_cast<std::int32_t>(end.by);
    event.codes = codes_of(end);
    event.text = end.words.c_str();
    master.bus.tell(event);
  };
  connect(master, own.ring());
}

void acyclic(dpsim_master* master, std::uint32_t peer, const bus::AcyclicRequest& request, std::uint32_t* id) {
  need(master, "master");
  if (master->class_1 != nullptr) {
    need_range("peer", peer, 0, bus::kHighestAddress);
    const auto address = static_cast<std::uint8_t>(peer);
    need_slave(*master->class_1, address);
    return numbered(*master, id, [&](std::uint32_t number) {
      master->class_1->c1_request(address, request, acyclic_done(*master, number, address));
    });
  }
  need_connection(*master->class_2, peer);
  const bus::Connection& connection = master->class_2->connection(peer);
  if (connection.state() == bus::ConnectionState::kClosed)
    fail(DPSIM_ERR_STATE, "connection " + std::to_string(peer) + " is closed");
  numbered(*master, id, [&](std::uint32_t number) {
    master->class_2->request(peer, request, acyclic_done(*master, number, connection.parameters().slave));
  });
}

}  // namespace dsdpv1::capi

namespace {

bus::ConnectionParameters parameters_of(const dpsim_connection_options& options) {
  bus::ConnectionParameters parameters;
  parameters.slave = options.slave;
  if (options.send_timeout != 0) parameters.send_timeout = options.send_timeout;
  parameters.response_timeout = options.response_timeout;
  if (options.features[0] != 0 || options.features[1] != 0)
    parameters.features = {options.features[0], options.features[1]};
  parameters.profile_features = {options.profile_features[0], options.profile_features[1]};
  parameters.profile_ident = options.profile_ident;
  capi::need_range("add_addr_size", options.add_addr_size, 0, sizeof options.add_addr);
  if (options.add_addr_size != 0) parameters.add_addr = capi::bytes_of(options.add_addr, options.add_addr_size);
  parameters.poll_interval_us = options.poll_interval_us;
  return parameters;
}

dpsim_connection_status status_of(const bus::Connection& connection) {
  dpsim_connection_status status{};
  status.state = static_cast<dpsim_connection_state>(connection.state());
  status.sap = connection.granted().sap ? static_cast<std::int16_t>(*connection.granted().sap) : DPSIM_NO_SAP;
  status.send_timeout = connection.granted().send_timeout;
  status.max_length = connection.granted().max_length;
  status.open_requests = static_cast<std::uint32_t>(connection.open_operations());
  return status;
}

}  // namespace

dpsim_status dpsim_master_add_connection(dpsim_master* master, const dpsim_connection_options* options,
                                         uint32_t* connection) {
  return guarded(
      __func__,
      [&] {
        bus::Master2& own = class_2_of(master);
        capi::need(connection, "connection");
        const bus::ConnectionParameters parameters = parameters_of(capi::options_of(options, "options"));
        *connection = static_cast<std::uint32_t>(own.add_connection(parameters));
      });
}

dpsim_status dpsim_master_connect(dpsim_master* master, uint32_t connection) {
  return guarded(
      __func__,
      [&] {
        bus::Master2& own = class_2_of(master);
        capi::need_connection(own, connection);
        own.connect(connection);
      });
}

dpsim_status dpsim_master_abort(dpsim_master* master, uint32_t connection, uint8_t reason) {
  return guarded(
      __func__,
      [&] {
        bus::Master2& own = class_2_of(master);
        capi::need_connection(own, connection);
        capi::need_range("reason", reason, 0, 15);
        bus::AbortReason why;
        why.reason = reason;
        own.abort(connection, why);
      });
}

dpsim_status dpsim_master_get_connection(const dpsim_master* master, uint32_t connection,
                                         dpsim_connection_status* status) {
  return guarded(
      __func__,
      [&] {
        const bus::Master2& own = class_2_of(master);
        capi::need_connection(own, connection);
        capi::give(status_of(own.connection(connection)), status, "status");
      });
}

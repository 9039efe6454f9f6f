// SPDX-FileCopyrightText: 2026 the dsdpv1 authors
// SPDX-License-Identifier: Apache-2.0
// Requests of a bench to its master.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "bindings/simulator/bytes.hpp"
#include "bindings/simulator/master.hpp"
#include "bindings/simulator/options.hpp"
#include "bindings/simulator/simulator.h"

namespace dsdpv1::simulator {
namespace {

void set_slave_members(dpsim_slave& slave, const char* text) {
  for (const Option& option : options_of(text)) {
    const auto value = [&](int64_t maximum) { return number_of(option, 0, maximum); };
    if (option.name == "ident")
      slave.ident = static_cast<uint16_t>(value(0xFFFF));
    else if (option.name == "group_ident")
      slave.group_ident = static_cast<uint8_t>(value(255));
    else if (option.name == "flags")
      slave.flags = static_cast<uint32_t>(value(63));
    else if (option.name == "wd_fact_1")
      slave.wd_fact_1 = static_cast<uint8_t>(value(255));
    else if (option.name == "wd_fact_2")
      slave.wd_fact_2 = static_cast<uint8_t>(value(255));
    else if (option.name == "min_tsdr")
      slave.min_tsdr = static_cast<uint8_t>(value(255));
    else if (option.name == "input_length")
      slave.input_length = static_cast<uint16_t>(value(DPSIM_MAX_IO));
    else if (option.name == "output_length")
      slave.output_length = static_cast<uint16_t>(value(DPSIM_MAX_IO));
    else if (option.name == "c1_response_timeout")
      slave.c1_response_timeout = static_cast<int32_t>(value(65535));
    else if (option.name == "min_slave_interval_us")
      slave.min_slave_interval_us = static_cast<int32_t>(value(1'000'000));
    else
      throw Error(DPSIM_ERR_NOT_FOUND,
                  "option " + option.name + " of a slave is unknown, expected the members of dpsim_slave");
  }
}

/// `flags` among the options, which must be known before the GSD is read.
uint32_t flags_of(const char* text) {
  dpsim_slave slave{};
  set_slave_members(slave, text);
  return slave.flags;
}

dpsim_slave read_gsd(const char* path, const char* modules, uint32_t flags) {
  dpsim_gsd* gsd = nullptr;
  check(dpsim_gsd_load(path, &gsd));
  const std::vector<std::string> names = words_of(modules, ";");
  std::vector<const char*> pointers;
  pointers.reserve(names.size());
  for (const std::string& name : names) pointers.push_back(name.c_str());
  dpsim_slave slave{};
  slave.size = sizeof slave;
  const dpsim_status status = dpsim_gsd_slave(gsd, pointers.data(), pointers.size(), flags, &slave);
  dpsim_gsd_destroy(gsd);
  check(status);
  return slave;
}

void copy(uint8_t* to, std::size_t capacity, const std::vector<uint8_t>& bytes, const char* what) {
  if (bytes.size() > capacity)
    throw Error(DPSIM_ERR_ARGUMENT, std::string(what) + " has " + std::to_string(bytes.size()) +
                                        " bytes, expected 0 to " + std::to_string(capacity));
  std::copy(bytes.begin(), bytes.end(), to);
}

/// Throws Error if a parameter of a task is out of range.
uint8_t byte_of(const char* name, int32_t value) {
  if (value < 0 || value > 255)
    throw Error(DPSIM_ERR_ARGUMENT, std::string(name) + " is " + std::to_string(value) + ", expected 0 to 255");
  return static_cast<uint8_t>(value);
}

/// Calls `command` with the master's handle.
template <class Command>
int32_t command(int32_t handle, const Command& command) {
  return guarded([&] {
    check(command(get<Master>(handle).master()));
    return 0;
  });
}

/// As above for a request: returns its number.
template <class Request>
int32_t request(int32_t handle, const Request& request) {
  return guarded([&] {
    uint32_t id = 0;
    check(request(get<Master>(handle).master(), &id));
    return static_cast<int32_t>(id);
  });
}

constexpr uint8_t kSrdHigh = 0x4D;

dpsim_telegram telegram_of(int32_t address, int32_t dsap, int32_t ssap, const std::vector<uint8_t>& data) {
  dpsim_telegram telegram{};
  telegram.size = sizeof telegram;
  telegram.kind = data.empty() && dsap < 0 && ssap < 0 ? DPSIM_SD1 : DPSIM_SD2;
  telegram.da = byte_of("address", address);
  telegram.fc = kSrdHigh;
  telegram.dsap = static_cast<int16_t>(std::max(dsap, -1));
  telegram.ssap = static_cast<int16_t>(std::max(ssap, -1));
  copy(telegram.data, sizeof telegram.data, data, "the request");
  telegram.data_size = static_cast<uint16_t>(data.size());
  return telegram;
}

}  // namespace
}  // namespace dsdpv1::simulator

using namespace dsdpv1::simulator;  // NOLINT(google-build-using-namespace): below are its functions for C

int32_t dsdpv1_master_add_gsd(int32_t handle, const char* path, const char* modules, int32_t address,
                              const char* options) {
  return guarded([&] {
    dpsim_slave slave = read_gsd(path, modules, flags_of(options));
    const uint32_t flags = slave.flags;
    set_slave_members(slave, options);
    slave.flags |= flags;
    slave.address = byte_of("address", address);
    check(dpsim_master_add_slave(get<Master>(handle).master(), &slave));
    return 0;
  });
}

// NOLINTNEXTLINE(readability-function-size): a vector and its number of bytes are two parameters in DPI and VPI
int32_t dsdpv1_master_add_slave(int32_t handle, int32_t address, const char* options, const uint32_t* prm,
                                int32_t prm_size, const uint32_t* cfg, int32_t cfg_size) {
  return guarded([&] {
    dpsim_slave slave{};
    slave.size = sizeof slave;
    set_slave_members(slave, options);
    slave.address = byte_of("address", address);
    copy(slave.user_prm, sizeof slave.user_prm, bytes_of(prm, prm_size), "User_Prm_Data");
    copy(slave.cfg, sizeof slave.cfg, bytes_of(cfg, cfg_size), "Cfg_Data");
    slave.user_prm_size = static_cast<uint16_t>(prm_size);
    slave.cfg_size = static_cast<uint16_t>(cfg_size);
    check(dpsim_master_add_slave(get<Master>(handle).master(), &slave));
    return 0;
  });
}

int32_t dsdpv1_master_start(int32_t handle) { return command(handle, dpsim_master_start); }
int32_t dsdpv1_master_stop(int32_t handle) { return command(handle, dpsim_master_stop); }
int32_t dsdpv1_master_set_baud(int32_t handle, int32_t baud) {
  return command(
      handle, [&](dpsim_master* master) { return dpsim_master_set_baud(master, baud); });
}
int32_t dsdpv1_master_set_clear(int32_t handle, int32_t clear) {
  return command(
      handle, [&](dpsim_master* master) { return dpsim_master_set_clear(master, clear); });
}
int32_t dsdpv1_master_release(int32_t handle, int32_t address) {
  return command(
      handle, [&](dpsim_master* master) { return dpsim_master_release(master, byte_of("address", address)); });
}
int32_t dsdpv1_master_activate(int32_t handle, int32_t address) {
  return command(
      handle, [&](dpsim_master* master) { return dpsim_master_activate(master, byte_of("address", address)); });
}

int32_t dsdpv1_master_set_outputs(int32_t handle, int32_t address, const uint32_t* data, int32_t count) {
  return command(
      handle,
      [&](dpsim_master* master) {
        const std::vector<uint8_t> bytes = bytes_of(data, count);
        return dpsim_master_set_outputs(master, byte_of("address", address), bytes.data(), bytes.size());
      });
}

int32_t dsdpv1_master_get_inputs(int32_t handle, int32_t address, uint32_t* data) {
  return guarded([&] {
    const dpsim_slave_status slave = get<Master>(handle).slave(address);
    return write_bytes(data, slave.inputs, slave.input_count);
  });
}

int32_t dsdpv1_master_slave_state(int32_t handle, int32_t address) {
  return guarded([&] { return get<Master>(handle).slave(address).state; });
}

int32_t dsdpv1_master_exchanges(int32_t handle, int32_t address) {
  return guarded([&] { return static_cast<int32_t>(get<Master>(handle).slave(address).data_exchanges); });
}

int32_t dsdpv1_master_ask(int32_t handle, int32_t service, int32_t address) {
  return request(
      handle, [&](dpsim_master* master,
                  uint32_t* id) { return dpsim_master_ask(master, service, byte_of("address", address), id); });
}

int32_t dsdpv1_master_request(int32_t handle, int32_t address, int32_t dsap, int32_t ssap, const uint32_t* data,
                              int32_t count) {
  return request(
      handle,
      [&](dpsim_master* master, uint32_t* id) {
        const dpsim_telegram telegram = telegram_of(address, dsap, ssap, bytes_of(data, count));
        return dpsim_master_request(master, &telegram, id);
      });
}

int32_t dsdpv1_master_global_control(int32_t handle, int32_t control, int32_t group, int32_t address) {
  return request(
      handle,
      [&](dpsim_master* master, uint32_t* id) {
        return dpsim_master_global_control(master, byte_of("command", control), byte_of("group", group),
                                           byte_of("address", address), id);
      });
}

int32_t dsdpv1_master_set_slave_address(int32_t handle, int32_t address, int32_t new_address, int32_t ident,
                                        int32_t lock) {
  return request(
      handle,
      [&](dpsim_master* master, uint32_t* id) {
        return dpsim_master_set_slave_address(master, byte_of("address", address), byte_of("new_address", new_address),
                                              static_cast<uint16_t>(ident), lock, id);
      });
}

int32_t dsdpv1_master_read(int32_t handle, int32_t peer, int32_t slot, int32_t index, int32_t count) {
  return request(
      handle,
      [&](dpsim_master* master, uint32_t* id) {
        return dpsim_master_read(master, static_cast<uint32_t>(peer), byte_of("slot", slot), byte_of("index", index),
                                 byte_of("count", count), id);
      });
}

int32_t dsdpv1_master_write(int32_t handle, int32_t peer, int32_t slot, int32_t index, const uint32_t* data,
                            int32_t count) {
  return request(
      handle,
      [&](dpsim_master* master, uint32_t* id) {
        const std::vector<uint8_t> bytes = bytes_of(data, count);
        return dpsim_master_write(master, static_cast<uint32_t>(peer), byte_of("slot", slot), byte_of("index", index),
                                  bytes.data(), bytes.size(), id);
      });
}

int32_t dsdpv1_master_transport(int32_t handle, int32_t peer, int32_t slot, int32_t index, const uint32_t* data,
                                int32_t count) {
  return request(
      handle,
      [&](dpsim_master* master, uint32_t* id) {
        const std::vector<uint8_t> bytes = bytes_of(data, count);
        return dpsim_master_transport(master, static_cast<uint32_t>(peer), byte_of("slot", slot),
                                      byte_of("index", index), bytes.data(), bytes.size(), id);
      });
}

int32_t dsdpv1_master_done(int32_t handle, int32_t id, int32_t* outcome, int32_t* codes, uint32_t* data,
                           int32_t* count) {
  return guarded([&] {
    Answer answer;
    if (!get<Master>(handle).take_answer(static_cast<uint32_t>(id), answer)) return 0;
    *outcome = answer.outcome;
    *codes = static_cast<int32_t>(answer.codes);
    *count = write_bytes(data, answer.data.data(), answer.data.size());
    return 1;
  });
}

int32_t dsdpv1_master_add_connection(int32_t handle, int32_t slave, int32_t send_timeout) {
  return request(
      handle,
      [&](dpsim_master* master, uint32_t* connection) {
        dpsim_connection_options options{};
        options.size = sizeof options;
        options.slave = byte_of("slave", slave);
        options.send_timeout = static_cast<uint16_t>(send_timeout);
        return dpsim_master_add_connection(master, &options, connection);
      });
}

int32_t dsdpv1_master_connect(int32_t handle, int32_t connection) {
  return command(
      handle, [&](dpsim_master* master) { return dpsim_master_connect(master, static_cast<uint32_t>(connection)); });
}

int32_t dsdpv1_master_abort(int32_t handle, int32_t connection, int32_t reason) {
  return command(
      handle,
      [&](dpsim_master* master) {
        return dpsim_master_abort(master, static_cast<uint32_t>(connection), byte_of("reason", reason));
      });
}

int32_t dsdpv1_master_connection_state(int32_t handle, int32_t connection) {
  return guarded([&] {
    dpsim_connection_status status{};
    status.size = sizeof status;
    check(dpsim_master_get_connection(get<Master>(handle).master(), static_cast<uint32_t>(connection), &status));
    return status.state;
  });
}

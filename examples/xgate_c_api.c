/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The C API with an XGate-DPS10: this program is the module's host. It runs driver/xgate on the UART of a module of
 * libdsdpv1.so; a master with the module's GSD file brings it up, sends user parameters and exchanges data.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/xgate/xgate.h"
#include "dsdpv1/dsdpv1.h"

enum { kAddress = 6, kRate = 115200, kMs = 12000000 };

static void check(dpsim_status status) {
  if (status == DPSIM_OK) return;
  fprintf(stderr, "%s: %s\n", dpsim_status_name(status), dpsim_error_message());
  exit(2);
}

static uint64_t now_of(const dpsim_chip* chip) {
  uint64_t now = 0;
  check(dpsim_chip_now(chip, &now));
  return now;
}

static void say(const dpsim_chip* chip, const char* what, const uint8_t* bytes, size_t count) {
  printf("%10.3f us  %s", (double)now_of(chip) / (1000 * DPSIM_TICKS_PER_NS), what);
  for (size_t i = 0; i < count; ++i) printf(" %02X", bytes[i]);
  printf("\n");
}

/* ---- the host's port: while it sends or waits, the bus continues ---- */

static void send_bytes(void* chip, const uint8_t* bytes, uint16_t length) {
  uint64_t end = 0;
  check(dpsim_chip_uart_send(chip, now_of(chip), bytes, length, &end));
}

static int receive_byte(void* chip, uint16_t ms) {
  uint8_t byte = 0;
  size_t count = 0;
  check(dpsim_chip_uart_receive(chip, now_of(chip) + (uint64_t)ms * kMs, &byte, 1, &count));
  return count == 0 ? -1 : byte;
}

static void show_parameters(void* chip, const uint8_t* bytes, uint8_t length) {
  say(chip, "host: user parameters", bytes, length);
}

static void initialise(xgate_module* host, const dpsim_slave* slave) {
  xgate_config config;
  memset(&config, 0, sizeof config);
  config.address = kAddress;
  config.ident = slave->ident;
  config.inputs = (uint8_t)slave->input_length;
  config.outputs = (uint8_t)slave->output_length;
  config.user_parameters = (uint8_t)slave->user_prm_size;
  config.cfg_length = (uint8_t)slave->cfg_size;
  memcpy(config.cfg, slave->cfg, slave->cfg_size);
  const xgate_result result = xgate_initialise(host, &config);
  say(host->port.context, result == XGATE_OK ? "host: initialised" : "host: command 04 failed", NULL, 0);
}

/* Returns the outputs of the master, inverted. */
static void exchange(xgate_module* host, uint8_t* data, uint8_t size) {
  uint8_t outputs[XGATE_MAX_DATA], length = 0;
  const xgate_result result = xgate_exchange(host, data, size, outputs, sizeof outputs, &length);
  if (result == XGATE_OK)
    say(host->port.context, "host: outputs", outputs, length);
  else
    printf("host: result %d, error %u/%u\n", (int)result, host->error_class, host->error_code);
  for (uint8_t i = 0; i < size; ++i) data[i] = (uint8_t)~outputs[i];
}

int main(int argc, char** argv) {
  if (argc != 2) {
    fprintf(stderr, "usage: %s xgate.gsd\n", argv[0]);
    return 2;
  }
  const char* const modules[] = {"4 bytes in, 4 bytes out, with parameters"};
  dpsim_gsd* gsd = NULL;
  dpsim_slave slave = {.size = sizeof slave};
  check(dpsim_gsd_load(argv[1], &gsd));
  check(dpsim_gsd_slave(gsd, modules, 1, 0, &slave));
  dpsim_gsd_destroy(gsd);
  slave.address = kAddress;

  dpsim_bus* bus = NULL;
  dpsim_chip* chip = NULL;
  dpsim_master* master = NULL;
  dpsim_chip_options options = {.size = sizeof options};
  options.kind = "xgate";
  check(dpsim_bus_create(NULL, &bus));
  check(dpsim_bus_add_chip(bus, &options, &chip));
  check(dpsim_bus_add_master(bus, NULL, &master));
  check(dpsim_master_add_slave(master, &slave));
  const uint8_t outputs[] = {1, 2, 3, 4};
  check(dpsim_master_set_outputs(master, kAddress, outputs, sizeof outputs));

  uint16_t reset = 0;
  check(dpsim_pin_find("xgate", "RESET", &reset));
  check(dpsim_chip_uart_open(chip, kRate));
  check(dpsim_chip_set(chip, kMs, reset, 1));
  check(dpsim_chip_advance(chip, 12 * kMs)); /* X18: 10 ms to the first frame */

  xgate_module host;
  const xgate_port port = {chip, send_bytes, receive_byte};
  const xgate_application application = {chip, show_parameters, NULL, NULL};
  xgate_open(&host, &port, &application);
  initialise(&host, &slave);
  check(dpsim_master_start(master));
  check(dpsim_bus_run(bus, now_of(chip) + 5 * kMs));
  uint8_t data[4] = {0};
  for (int turn = 0; turn < 3; ++turn) exchange(&host, data, sizeof data);

  dpsim_slave_status status = {.size = sizeof status};
  check(dpsim_master_get_slave(master, kAddress, &status));
  say(chip, "master: inputs", status.inputs, status.input_count);
  dpsim_bus_destroy(bus);
  return 0;
}

/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The C API: a master brings up a slave whose user CPU is this program. It runs the C driver on a chip of
 * libdsdpv1.so, pin by pin. Masters of class 1 and 2 then read and write one of its objects by acyclic requests. At
 * the end the checks of the user's side are evaluated.
 */
#include <stdio.h>
#include <stdlib.h>

#include "driver/dsdpv1_acyclic.h"
#include "dsdpv1/dsdpv1.h"

enum { kAddress = 5, kSlot = 1, kIndex = 2, kOfClass1 = 3, kRequests = 5 };

static void check(dpsim_status status) {
  if (status == DPSIM_OK) return;
  fprintf(stderr, "%s: %s\n", dpsim_status_name(status), dpsim_error_message());
  exit(2); /* as the programs do for wrong input */
}

static double us(uint64_t ticks) { return (double)ticks / (1000 * DPSIM_TICKS_PER_NS); }

/* ---- the user CPU: each action takes time, and the bus continues meanwhile ---- */

typedef struct {
  dpsim_chip* chip;
  uint64_t now;
} user;

static uint8_t read_cell(void* ctx, uint16_t address) {
  user* self = ctx;
  dpsim_level value = DPSIM_X;
  check(dpsim_chip_read(self->chip, self->now, address, NULL, &value, &self->now));
  return (uint8_t)value;
}

static void write_cell(void* ctx, uint16_t address, uint8_t value) {
  user* self = ctx;
  check(dpsim_chip_write(self->chip, self->now, address, value, NULL, &self->now));
}

static void pass(void* ctx, uint32_t ns) {
  user* self = ctx;
  self->now += (uint64_t)ns * DPSIM_TICKS_PER_NS;
  check(dpsim_chip_advance(self->chip, self->now));
}

static void set_pin(user* self, uint16_t pin, bool level) {
  check(dpsim_chip_set(self->chip, self->now, pin, level ? 1 : 0));
  pass(self, 50);
}

static bool get_pin(user* self, uint16_t pin) {
  dpsim_level level = DPSIM_X;
  pass(self, 50);
  check(dpsim_chip_level(self->chip, pin, &level));
  return level != 0;
}

static void set_r_req(void* ctx, bool level) { set_pin(ctx, DPSIM_DSDPV1_R_REQ, level); }
static void set_r_sta(void* ctx, bool level) { set_pin(ctx, DPSIM_DSDPV1_R_STA, level); }
static bool get_l_req(void* ctx) { return get_pin(ctx, DPSIM_DSDPV1_L_REQ); }
static bool get_l_sta(void* ctx) { return get_pin(ctx, DPSIM_DSDPV1_L_STA); }

static void initialise(user* self, dsdpv1_device* device, const dpsim_slave* slave) {
  const dsdpv1_port port = {self, read_cell, write_cell, set_r_req, set_r_sta, get_l_req, get_l_sta, pass};
  dsdpv1_config config = {0};
  config.address = slave->address;
  config.ident = slave->ident;
  config.max_input = (uint8_t)slave->input_length;
  config.max_output = (uint8_t)slave->output_length;
  config.max_cfg = config.cfg_length = (uint8_t)slave->cfg_size;
  config.cfg = slave->cfg;
  config.max_prm = DSDPV1_MAX_PRM;
  config.dpv1 = true;
  dsdpv1_open(device, &port, NULL);
  dsdpv1_error error = dsdpv1_wait_ready(device);
  if (error == DSDPV1_OK) error = dsdpv1_initialise(device, &config);
  printf("%10.3f us  initialised: %s\n", us(self->now), dsdpv1_error_text(error));
}

/* A DS_Transport of the object returns the received bytes in reverse order. Request and reply share their memory. */
static dsdpv1_outcome reverse(void* unused, const dsdpv1_request* request, dsdpv1_reply* reply) {
  (void)unused;
  for (unsigned i = 0; i < request->length / 2u; ++i) {
    const uint8_t last = request->data[request->length - 1u - i];
    reply->data[request->length - 1u - i] = request->data[i];
    reply->data[i] = last;
  }
  reply->length = request->length;
  return DSDPV1_DONE;
}

/* One object, for both classes. The driver serves reads and writes of its bytes and refuses all others. */
static void open_object(dsdpv1_acyclic* acyclic, dsdpv1_device* device) {
  static uint8_t bytes[] = {0x11, 0x22, 0x33, 0x44};
  static dsdpv1_object object = {.slot = kSlot, .index = kIndex, .max_length = sizeof bytes, .data = bytes};
  object.services = DSDPV1_MAY_READ | DSDPV1_MAY_WRITE | DSDPV1_MAY_TRANSPORT;
  object.classes = DSDPV1_CLASS_BOTH;
  object.transport = reverse;
  const dsdpv1_table table = {&object, 1, NULL};
  const dsdpv1_error error = dsdpv1_acyclic_open(acyclic, device, &table);
  if (error != DSDPV1_OK) printf("table: %s\n", dsdpv1_error_text(error));
}

/* ---- acyclic requests of the masters ---- */

typedef struct {
  dpsim_master *first, *second; /* of class 1, of class 2 */
  uint32_t connection;
  int ended; /* number of kRequests that have ended */
} dialogue;

static void ask_by_class_1(dialogue* self) {
  const uint8_t bytes[] = {0xAA, 0xBB, 0xCC, 0xDD};
  check(dpsim_master_read(self->first, kAddress, kSlot, kIndex, 10, NULL));
  check(dpsim_master_write(self->first, kAddress, kSlot, kIndex, bytes, sizeof bytes, NULL));
  check(dpsim_master_read(self->first, kAddress, kSlot + 1, kIndex, 10, NULL)); /* a slot that does not exist */
}

static void ask_by_class_2(dialogue* self) {
  const uint8_t bytes[] = {1, 2, 3};
  check(dpsim_master_read(self->second, self->connection, kSlot, kIndex, 10, NULL));
  check(dpsim_master_transport(self->second, self->connection, kSlot, kIndex, bytes, sizeof bytes, NULL));
}

/* ---- callbacks ---- */

static void told(void* ctx, const dpsim_event* event) {
  dialogue* self = ctx;
  if (event->type == DPSIM_EVENT_SLAVE_STATE && event->to == DPSIM_SLAVE_DATA_EXCHANGE)
    printf("%10.3f us  the master is in data exchange with slave %u\n", us(event->tick), event->address);
  if (event->type == DPSIM_EVENT_CONNECTION_STATE && event->from == DPSIM_CONNECTION_CONNECTING &&
      event->to == DPSIM_CONNECTION_OPEN)
    ask_by_class_2(self);
  if (event->type != DPSIM_EVENT_ACYCLIC_DONE) return;
  printf("%10.3f us  %s\n", us(event->tick), event->text);
  ++self->ended;
}

static void print_event(void* unused, const dpsim_chip_event* event) {
  char text[256];
  (void)unused;
  check(dpsim_chip_event_text(NULL, event, text, sizeof text));
  printf("%10.3f us  %s\n", us(event->tick), text);
}

/* Feeds all changes kept since the last call to the checker. */
static void feed(dpsim_chip* chip, dpsim_checker* checker) {
  dpsim_change changes[256];
  size_t count = 0;
  do {
    check(dpsim_chip_read_changes(chip, changes, 256, &count));
    check(dpsim_checker_pins(checker, changes, count, NULL));
  } while (count == 256);
}

static void print_checks(const dpsim_checker* checker) {
  unsigned long long applied = 0, violated = 0;
  for (size_t rule = 0; rule < dpsim_rule_count(NULL); ++rule) {
    dpsim_check_result result = {sizeof result, 0, 0, 0, 0, 0, 0, 0, 0};
    check(dpsim_checker_get_result(checker, rule, &result));
    applied += result.count;
    violated += result.violations;
  }
  printf("rules applied %s, violations: %llu\n", applied > 0 ? "thousands of times" : "never", violated);
}

static dpsim_slave slave_of(const char* path) {
  dpsim_gsd* gsd = NULL;
  dpsim_slave slave = {0};
  const char* modules[] = {"8 bytes in, 8 bytes out"};
  slave.size = sizeof slave;
  check(dpsim_gsd_load(path, &gsd));
  check(dpsim_gsd_slave(gsd, modules, 1, DPSIM_PRM_DPV1, &slave));
  dpsim_gsd_destroy(gsd);
  slave.address = kAddress;
  return slave;
}

static dpsim_master* add_master(dpsim_bus* bus, int32_t master_class, uint8_t address) {
  dpsim_master* master = NULL;
  dpsim_master_options options = {0};
  options.size = sizeof options;
  options.master_class = master_class;
  options.address = address;
  options.highest_address = kAddress;
  options.ring = 1;
  options.gap_factor = 1; /* the second one is soon admitted */
  check(dpsim_bus_add_master(bus, &options, &master));
  return master;
}

static void add_masters(dialogue* self, dpsim_bus* bus, const dpsim_slave* slave) {
  const uint8_t outputs[] = {1, 2, 3, 4, 5, 6, 7, 8};
  dpsim_connection_options options = {0};
  options.size = sizeof options;
  options.slave = slave->address;
  self->first = add_master(bus, 1, 2);
  check(dpsim_master_add_slave(self->first, slave));
  check(dpsim_master_set_outputs(self->first, slave->address, outputs, sizeof outputs));
  self->second = add_master(bus, 2, 3);
  check(dpsim_master_add_connection(self->second, &options, &self->connection));
}

/* The user's program, until it has outputs. */
static void exchange(user* self, dsdpv1_device* device) {
  const uint8_t inputs[8] = {0xCA, 0xFE};
  for (int turn = 0; turn < 100; ++turn) {
    uint8_t received[8];
    dsdpv1_exchange_result result = {received, sizeof received, 0, false, false, false};
    pass(self, 100000);
    dsdpv1_service(device);
    dsdpv1_exchange(device, DSDPV1_INPUT_NEWEST, inputs, sizeof inputs, &result);
    if (!result.outputs_new) continue;
    printf("%10.3f us  outputs: %u bytes, the first two %02X %02X\n", us(self->now), result.length, received[0],
           received[1]);
    return;
  }
}

/* Requests have no interrupt (P7): the user polls for them, here until `count` have ended. */
static void serve(user* self, dsdpv1_acyclic* acyclic, const dialogue* masters, int count) {
  for (int turn = 0; turn < 5000 && masters->ended < count; ++turn) {
    pass(self, 20000);
    dsdpv1_acyclic_poll(acyclic, NULL);
  }
}

static void talk(user* self, dsdpv1_acyclic* acyclic, dialogue* masters) {
  ask_by_class_1(masters);
  serve(self, acyclic, masters, kOfClass1);
  check(dpsim_master_connect(masters->second, masters->connection));
  serve(self, acyclic, masters, kRequests);
  printf("acyclic requests that have ended: %d of %d\n", masters->ended, kRequests);
}

static void print_inputs(const dpsim_master* master) {
  dpsim_slave_status seen = {0};
  seen.size = sizeof seen;
  check(dpsim_master_get_slave(master, kAddress, &seen));
  if (seen.input_count >= 2) printf("inputs at the master: %02X %02X\n", seen.inputs[0], seen.inputs[1]);
}

int main(int argc, char** argv) {
  dpsim_bus* bus = NULL;
  dpsim_checker* checker = NULL;
  dsdpv1_device device;
  dsdpv1_acyclic acyclic;
  dialogue masters = {NULL, NULL, 0, 0};
  user cpu = {NULL, 0};
  const dpsim_slave slave = slave_of(argc > 1 ? argv[1] : "scenarios/dsdpv1.gsd");

  check(dpsim_bus_create(NULL, &bus));
  check(dpsim_bus_add_chip(bus, NULL, &cpu.chip));
  add_masters(&masters, bus, &slave);
  check(dpsim_chip_on_event(cpu.chip, print_event, NULL));
  check(dpsim_bus_on_event(bus, told, &masters));
  check(dpsim_checker_create(NULL, &checker));
  check(dpsim_chip_watch(cpu.chip, DPSIM_ALL_PINS, NULL, NULL));

  cpu.now = 20 * DPSIM_TICKS_PER_CYCLE;
  check(dpsim_chip_set(cpu.chip, cpu.now, DPSIM_DSDPV1_RESET, 1));
  pass(&cpu, 1000);
  initialise(&cpu, &device, &slave);
  open_object(&acyclic, &device);
  check(dpsim_master_start(masters.first));
  check(dpsim_master_start(masters.second));
  exchange(&cpu, &device);
  pass(&cpu, 100000);
  print_inputs(masters.first);
  talk(&cpu, &acyclic, &masters);

  feed(cpu.chip, checker);
  check(dpsim_checker_finish(checker, cpu.now));
  print_checks(checker);
  dpsim_checker_destroy(checker);
  dpsim_bus_destroy(bus);
  return masters.ended == kRequests ? 0 : 1;
}

/*
 * The C API: a master brings a slave up whose user CPU is this program. It runs the C driver; the driver's port is a
 * chip of libdsdpv1.so, pin by pin. At the end the rules of the user's side are looked at.
 */
#include <stdio.h>
#include <stdlib.h>

#include "driver/dsdpv1.h"
#include "dsdpv1/dsdpv1.h"

enum { kAddress = 5 };

static void check(dpsim_status status) {
  if (status == DPSIM_OK) return;
  fprintf(stderr, "%s: %s\n", dpsim_status_name(status), dpsim_error_message());
  exit(1);
}

static double us(uint64_t ticks) { return (double)ticks / (1000 * DPSIM_TICKS_PER_NS); }

/* ---- the user CPU: each action takes its time, and the bus goes on meanwhile ---- */

typedef struct user {
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
  dsdpv1_open(device, &port, NULL);
  dsdpv1_error error = dsdpv1_wait_ready(device);
  if (error == DSDPV1_OK) error = dsdpv1_initialise(device, &config);
  printf("%10.3f us  initialised: %s\n", us(self->now), dsdpv1_error_text(error));
}

/* ---- what is told ---- */

static void print_state(void* unused, const dpsim_event* event) {
  (void)unused;
  if (event->type == DPSIM_EVENT_SLAVE_STATE && event->to == DPSIM_SLAVE_DATA_EXCHANGE)
    printf("%10.3f us  the master is in data exchange with slave %u\n", us(event->tick), event->address);
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
  check(dpsim_gsd_slave(gsd, modules, 1, 0, &slave));
  dpsim_gsd_destroy(gsd);
  slave.address = kAddress;
  return slave;
}

static dpsim_master* add_master(dpsim_bus* bus, const dpsim_slave* slave) {
  const uint8_t outputs[] = {1, 2, 3, 4, 5, 6, 7, 8};
  dpsim_master* master = NULL;
  dpsim_master_options options = {0};
  options.size = sizeof options;
  options.address = 2;
  check(dpsim_bus_add_master(bus, &options, &master));
  check(dpsim_master_add_slave(master, slave));
  check(dpsim_master_set_outputs(master, slave->address, outputs, sizeof outputs));
  return master;
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
  user cpu = {NULL, 0};
  const dpsim_slave slave = slave_of(argc > 1 ? argv[1] : "scenarios/dsdpv1.gsd");

  check(dpsim_bus_create(NULL, &bus));
  check(dpsim_bus_add_chip(bus, NULL, &cpu.chip));
  dpsim_master* master = add_master(bus, &slave);
  check(dpsim_chip_on_event(cpu.chip, print_event, NULL));
  check(dpsim_bus_on_event(bus, print_state, NULL));
  check(dpsim_checker_create(NULL, &checker));
  check(dpsim_chip_watch(cpu.chip, DPSIM_ALL_PINS, NULL, NULL));

  cpu.now = 20 * DPSIM_TICKS_PER_CYCLE;
  check(dpsim_chip_set(cpu.chip, cpu.now, DPSIM_DSDPV1_RESET, 1));
  pass(&cpu, 1000);
  initialise(&cpu, &device, &slave);
  check(dpsim_master_start(master));
  exchange(&cpu, &device);
  pass(&cpu, 100000);
  print_inputs(master);

  feed(cpu.chip, checker);
  check(dpsim_checker_finish(checker, cpu.now));
  print_checks(checker);
  dpsim_checker_destroy(checker);
  dpsim_bus_destroy(bus);
  return 0;
}

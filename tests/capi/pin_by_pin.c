#include "tests/capi/pin_by_pin.h"

#include <string.h>

enum { kNs = DPSIM_TICKS_PER_NS, kCycle = DPSIM_TICKS_PER_CYCLE };

/* Local to a thread: there may be several at once. */
struct User {
  dpsim_chip* chip;
  int failed;
};

static void check(struct User* user, dpsim_status status) {
  if (status != DPSIM_OK) user->failed = 1;
}

/* H2: R_REQ, then L_REQ and L_STA sampled low, then R_STA. */
static uint64_t take(struct User* user, uint64_t now) {
  dpsim_level l_req = DPSIM_X, l_sta = DPSIM_X;
  check(user, dpsim_chip_set(user->chip, now, DPSIM_DSDPV1_R_REQ, 1));
  do {
    now += 100 * kNs;
    check(user, dpsim_chip_advance(user->chip, now));
    check(user, dpsim_chip_level(user->chip, DPSIM_DSDPV1_L_REQ, &l_req));
    check(user, dpsim_chip_level(user->chip, DPSIM_DSDPV1_L_STA, &l_sta));
  } while ((l_req != 0 || l_sta != 0) && !user->failed);
  check(user, dpsim_chip_set(user->chip, now, DPSIM_DSDPV1_R_STA, 1));
  return now + 50 * kNs;
}

/* Table 15: A no later than RD's fall, D certain 31.25 ns after it. */
static dpsim_level read(struct User* user, uint64_t now, dpsim_level address) {
  dpsim_level value = DPSIM_X;
  check(user, dpsim_chip_set(user->chip, now, DPSIM_DSDPV1_A, address));
  check(user, dpsim_chip_set(user->chip, now, DPSIM_DSDPV1_CSR, 0));
  check(user, dpsim_chip_set(user->chip, now + 10 * kNs, DPSIM_DSDPV1_RD, 0));
  check(user, dpsim_chip_sample(user->chip, now + 50 * kNs, &value));
  check(user, dpsim_chip_set(user->chip, now + 50 * kNs, DPSIM_DSDPV1_RD, 1));
  check(user, dpsim_chip_set(user->chip, now + 50 * kNs, DPSIM_DSDPV1_CSR, 1));
  return value;
}

size_t drive_pin_by_pin(uint64_t released, dpsim_change* changes, size_t capacity) {
  struct User user = {NULL, 0};
  dpsim_chip_options options;
  uint64_t now = 7200 * (uint64_t)kCycle;
  size_t count = 0;
  memset(&options, 0, sizeof options);
  options.size = sizeof options;
  if (dpsim_chip_create(&options, &user.chip) != DPSIM_OK) return 0;
  check(&user, dpsim_chip_watch(user.chip, DPSIM_ALL_PINS & ~(DPSIM_PIN(DPSIM_DSDPV1_L_REQ) - 1), NULL, NULL));
  check(&user, dpsim_chip_set(user.chip, released, DPSIM_DSDPV1_RESET, 1));
  check(&user, dpsim_chip_advance(user.chip, now));
  now = take(&user, now);
  if (read(&user, now, 4) != 0xC5) user.failed = 1;
  check(&user, dpsim_chip_set(user.chip, now + 100 * kNs, DPSIM_DSDPV1_R_STA, 0));
  check(&user, dpsim_chip_set(user.chip, now + 100 * kNs, DPSIM_DSDPV1_R_REQ, 0));
  check(&user, dpsim_chip_advance(user.chip, now + 2000 * kNs));
  check(&user, dpsim_chip_read_changes(user.chip, changes, capacity, &count));
  dpsim_chip_destroy(user.chip);
  return user.failed ? 0 : count;
}

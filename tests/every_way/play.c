/* play INPUTS OUTPUTS END: changes of inputs to a chip of the C API; changes of its outputs. Lines of both: tick, pin,
 * level. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "dsdpv1/dsdpv1.h"

static void check(dpsim_status status) {
  if (status == DPSIM_OK) return;
  fprintf(stderr, "play: %s\n", dpsim_error_message());
  exit(1);
}

static void changed(void* outputs, const dpsim_change* change) {
  fprintf((FILE*)outputs, "%" PRIu64 " %u %d\n", change->tick, (unsigned)change->pin, change->level);
}

int main(int argc, char** argv) {
  FILE* inputs = argc == 4 ? fopen(argv[1], "r") : NULL;
  FILE* outputs = argc == 4 ? fopen(argv[2], "w") : NULL;
  dpsim_chip* chip = NULL;
  uint64_t tick = 0;
  uint16_t pin = 0;
  int16_t level = 0;
  if (inputs == NULL || outputs == NULL) return 2;
  check(dpsim_chip_create(NULL, &chip));
  check(dpsim_chip_watch(chip, DPSIM_ALL_PINS & ~(DPSIM_PIN(DPSIM_DSDPV1_L_REQ) - 1), changed, outputs));
  while (fscanf(inputs, "%" SCNu64 " %" SCNu16 " %" SCNd16, &tick, &pin, &level) == 3)
    check(dpsim_chip_set(chip, tick, pin, level));
  check(dpsim_chip_advance(chip, strtoull(argv[3], NULL, 10)));
  dpsim_chip_destroy(chip);
  fclose(inputs);
  return fclose(outputs) == 0 ? 0 : 1;
}

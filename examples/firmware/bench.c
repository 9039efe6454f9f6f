/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* Commands of the bench. */
#include "examples/firmware/bench.h"

#include "examples/firmware/bench_faults.h"
#include "examples/firmware/bench_telegrams.h"
#include "examples/firmware/board.h"
#include "examples/firmware/cyclic.h"
#include "examples/firmware/objects.h"
#include "examples/firmware/settings.h"
#include "examples/firmware/station.h"

static bool stopped;

bool bench_stopped(void) { return stopped; }

static void stop(bool stop) {
  stopped = stop;
  station_pause(stop);
}

static void carry_out(dsdpv1_device* chip, const dsdpv1_mailbox_command* command) {
  switch (command->kind) {
    case DSDPV1_CMD_SET_INPUTS: cyclic_set_inputs(command->bytes, command->length); break;
    case DSDPV1_CMD_SET_DIAGNOSIS:
      station_set_diagnosis((dsdpv1_diag_type)command->value, command->bytes, command->length);
      break;
    case DSDPV1_CMD_REINITIALISE: (void)station_initialise(&command->station); break;
    case DSDPV1_CMD_HOLD: bench_hold(chip, command->time_ns); break;
    case DSDPV1_CMD_STOP: stop(true); break;
    case DSDPV1_CMD_RESUME: stop(false); break;
    case DSDPV1_CMD_EARLY_R_STA: bench_early_r_sta(command->time_ns, command->hold_ns); break;
    case DSDPV1_CMD_WRONG_CRC: bench_wrong_crc(command->value, command->times); break;
    case DSDPV1_CMD_WRONG_LENGTH: cyclic_mistake_length(); break;
    case DSDPV1_CMD_VERDICT: station_send_verdict(command->value, command->refuse != 0u); break;
    case DSDPV1_CMD_ANSWERING: objects_answer(command->value); break;
    case DSDPV1_CMD_SPOIL: bench_spoil(command->value, command->times); break;
    default: break; /* from a newer bench: not supported by this firmware */
  }
}

void bench_run_commands(dsdpv1_device* chip) {
  if (!settings_from_bench()) return;
  while (dsdpv1_bench.done != dsdpv1_bench.posted) {
    board_barrier(); /* the command is complete before the count that announces it */
    carry_out(chip, &dsdpv1_bench.command);
    board_barrier();
    dsdpv1_bench.done = dsdpv1_bench.posted;
  }
}

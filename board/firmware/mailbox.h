#ifndef DSDPV1_BENCH_MAILBOX_H
#define DSDPV1_BENCH_MAILBOX_H
/*
 * How a scenario reaches firmware on the ARM board. Optional: firmware without it runs as it does on a real board, and
 * only the script's actions for the user CPU are refused.
 *
 * Firmware that wants it defines, in RAM that its start-up neither clears nor fills (section .noinit):
 *
 *   dsdpv1_mailbox dsdpv1_bench __attribute__((section(".noinit")));
 *
 * The bench finds the symbol in the ELF file. Before the first instruction it clears the mailbox and fills `magic`,
 * `version`, `size` and `settings`. Firmware that does not find magic, version and size as below runs on a real board
 * and uses settings of its own. Afterwards the bench writes `command` and then increments `posted`, when `done` equals
 * it; the firmware carries the command out, then sets `done` to `posted`. `report` is the firmware's: it writes the
 * data first, the count that announces them last.
 *
 * Little endian, natural alignment; times in nanoseconds.
 */
/* NOLINTBEGIN(modernize-deprecated-headers, modernize-use-using, readability-identifier-naming): C, also when included
 * by C++ */
#include <stdint.h>

#define DSDPV1_MAILBOX_SYMBOL "dsdpv1_bench"
#define DSDPV1_MAILBOX_MAGIC 0xD5D9B0C5u
#define DSDPV1_MAILBOX_VERSION 1u
#define DSDPV1_MAILBOX_OBJECTS 24
#define DSDPV1_MAILBOX_ERRORS 16

/* What the inputs are made of: loop back the outputs, count exchanges, `constant`, or written only once commanded. */
enum { DSDPV1_INPUTS_LOOP_BACK = 0, DSDPV1_INPUTS_COUNT = 1, DSDPV1_INPUTS_CONSTANT = 2, DSDPV1_INPUTS_IDLE = 3 };
/* Judgements of mode 2, and how acyclic requests are answered. */
enum { DSDPV1_SAY_YES = 0, DSDPV1_SAY_NO = 1, DSDPV1_SAY_NOTHING = 2 };

/* The members of dsdpv1_config, with the same limits. */
typedef struct dsdpv1_mailbox_station {
  uint16_t ident;
  uint8_t address, address_change, freeze, sync, fail_safe, dpv1;
  uint8_t max_input, max_output, max_diag, max_prm, max_cfg, prm_mode, cfg_mode;
  uint8_t cfg_length, cfg[200];
} dsdpv1_mailbox_station;

/* An object by slot and index: `services` are DSDPV1_MAY_ bits, `classes` DSDPV1_CLASS_ bits; `length` is also its
 * greatest. */
typedef struct dsdpv1_mailbox_object {
  uint8_t slot, index, services, classes, min_length, length, data[240];
} dsdpv1_mailbox_object;

/* I&M0; texts end with a 0. */
typedef struct dsdpv1_mailbox_nameplate {
  uint16_t manufacturer_id, hardware_revision, profile_id;
  uint8_t present, software_revision[3];
  char order_id[21], serial_number[17];
} dsdpv1_mailbox_nameplate;

typedef struct dsdpv1_mailbox_settings {
  uint64_t start_delay_ns;  /* from the start to the first look for the chip */
  uint64_t period_ns;       /* from the start of one exchange to the next, > 0 */
  uint64_t judge_delay_ns;  /* time that a judgement takes */
  uint64_t retry_delay_ns;  /* pause before a failed initialisation is repeated */
  uint64_t answer_delay_ns; /* from the poll that fetched an acyclic request to its answer */
  uint8_t inputs;           /* DSDPV1_INPUTS_ */
  uint8_t overwrite_inputs; /* 1: DSDPV1_INPUT_NEWEST, 0: DSDPV1_INPUT_WHEN_CONSUMED */
  uint8_t judge_in_handler; /* 1: the INTR0 handler judges; 0: it notes INTR0, the main loop judges */
  uint8_t prm_judgement, cfg_judgement, answering; /* DSDPV1_SAY_ */
  uint8_t error_code_1, error_code_2;              /* of answering = DSDPV1_SAY_NO */
  uint8_t constant_length, constant[244];
  uint8_t object_count;
  dsdpv1_mailbox_object objects[DSDPV1_MAILBOX_OBJECTS];
  dsdpv1_mailbox_nameplate im0;
  dsdpv1_mailbox_station station;
} dsdpv1_mailbox_settings;

/* What the script may ask for; the members that each uses. */
enum {
  DSDPV1_CMD_SET_INPUTS = 1,    /* bytes, length: the inputs from now on, with this length as it is */
  DSDPV1_CMD_SET_DIAGNOSIS = 2, /* value: dsdpv1_diag_type; bytes, length */
  DSDPV1_CMD_REINITIALISE = 3,  /* station */
  DSDPV1_CMD_HOLD = 4,          /* time_ns: takes the DPRAM and keeps it so long, interrupts closed */
  DSDPV1_CMD_STOP = 5,          /* nothing at all until RESUME, not even judge */
  DSDPV1_CMD_RESUME = 6,
  DSDPV1_CMD_EARLY_R_STA = 7, /* breaks H2: R_STA rises time_ns after R_REQ unasked, both fall after hold_ns */
  DSDPV1_CMD_WRONG_CRC =
      8, /* value: DSDPV1_AREA_; times: so many blocks go out with bit 0 of the CRC's high byte wrong */
  DSDPV1_CMD_WRONG_LENGTH = 9, /* the next inputs are one byte longer, shorter where that is impossible */
  DSDPV1_CMD_VERDICT = 10,     /* value: DSDPV1_VERDICT_PRM or _CFG; refuse */
  DSDPV1_CMD_ANSWERING = 11,   /* value: DSDPV1_SAY_ */
  DSDPV1_CMD_SPOIL = 12        /* value: DSDPV1_SPOIL_; times: so many telegrams over SPI or UART go wrong */
};
/* A wrong bit in the third byte; the telegram ends before it; that byte's parity is wrong (UART). */
enum { DSDPV1_SPOIL_BIT = 0, DSDPV1_SPOIL_CUT = 1, DSDPV1_SPOIL_PARITY = 2 };
enum {
  DSDPV1_AREA_INIT = 0,
  DSDPV1_AREA_INPUTS = 1,
  DSDPV1_AREA_DIAGNOSIS = 2,
  DSDPV1_AREA_C1_ANSWER = 3,
  DSDPV1_AREA_C2_ANSWER = 4
};

typedef struct dsdpv1_mailbox_command {
  uint64_t time_ns, hold_ns;
  uint32_t times;
  uint8_t kind; /* DSDPV1_CMD_ */
  uint8_t value, refuse;
  uint8_t length, bytes[244];
  dsdpv1_mailbox_station station;
} dsdpv1_mailbox_command;

/* The call of the driver that failed. */
enum {
  DSDPV1_DURING_WAIT_READY = 0,
  DSDPV1_DURING_INITIALISE = 1,
  DSDPV1_DURING_EXCHANGE = 2,
  DSDPV1_DURING_SERVICE = 3,
  DSDPV1_DURING_SET_DIAGNOSIS = 4,
  DSDPV1_DURING_SEND_VERDICT = 5,
  DSDPV1_DURING_ACYCLIC_OPEN = 6,
  DSDPV1_DURING_ACYCLIC_POLL = 7
};

typedef struct dsdpv1_mailbox_report {
  uint32_t exchanges, inputs_written, initialisations, judgements;
  uint32_t outputs_received; /* blocks of outputs with the right CRC; written behind length and bytes */
  uint8_t output_length, outputs[244];
  uint32_t error_count; /* errors since the start; number n is in errors[n % DSDPV1_MAILBOX_ERRORS] */
  struct {
    uint8_t error, during; /* dsdpv1_error, DSDPV1_DURING_ */
  } errors[DSDPV1_MAILBOX_ERRORS];
} dsdpv1_mailbox_report;

typedef struct dsdpv1_mailbox {
  uint32_t magic, version, size;
  volatile uint32_t posted, done;
  dsdpv1_mailbox_settings settings;
  dsdpv1_mailbox_command command;
  dsdpv1_mailbox_report report;
} dsdpv1_mailbox;

/* NOLINTEND(modernize-deprecated-headers, modernize-use-using, readability-identifier-naming) */

#endif /* DSDPV1_BENCH_MAILBOX_H */

/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
#ifndef XGATE_H
#define XGATE_H
/*
 * Host program for the XGate-DPS10: frames, repetitions, the queue of requests. Clauses and tables are those of its
 * data sheet, X3 ... of docs/xgate.md.
 *
 * C99, no allocation, no operating system. The device maker supplies two functions for the bytes of UART or SPI, and
 * the application. Every function waits for the module's answer; call all from one context.
 *
 *   xgate_module module;
 *   xgate_open(&module, &port, &application);
 *   while (xgate_initialise(&module, &config) != XGATE_OK) {}
 *   for (;;) {
 *     result = xgate_exchange(&module, in, sizeof in, out, sizeof out, &length);
 *   }
 */
/* NOLINTBEGIN(modernize-deprecated-headers, modernize-use-using): C, also when included by C++ */
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XGATE_MAX_DATA 255u /* of a frame */
#define XGATE_MAX_CFG 24u
#define XGATE_MAX_PDU 244u /* request or answer: function, slot, index, length, data (table 4.7) */
#define XGATE_DPV1_BYTES 12u
#define XGATE_QUEUE 2u /* requests at once: one of C1, one of C2 */

typedef enum xgate_result {
  XGATE_OK = 0,
  XGATE_ERR_ARGUMENT = 10, /* a null pointer, or a length out of its range */
  XGATE_ERR_SILENT = 11,   /* no whole answer after all repetitions */
  XGATE_ERR_ANSWER = 12,   /* an answer that is none to this command */
  XGATE_ERR_MODULE = 13    /* the module's error: error_class and error_code (tables 4.10 to 4.14) */
} xgate_result;

/* The line to the module. SPI: receive clocks a byte; what comes before 7EH is skipped (X14). */
typedef struct xgate_port {
  void* context;
  void (*send)(void* context, const uint8_t* bytes, uint16_t length);
  int (*receive)(void* context, uint16_t ms); /* the next byte, or -1: none came in that time */
} xgate_port;

/* Each function may be null: the item is dropped, a request is refused with B0H (invalid index). */
typedef struct xgate_application {
  void* context;
  /* New user parameters of the master, DPV1's three bytes first. */
  void (*parameters)(void* context, const uint8_t* bytes, uint8_t length);
  /* A request of C1 or C2: fills `answer` (at most XGATE_MAX_PDU bytes) and returns its length; 0: not yet, the next
     exchange asks again. */
  uint8_t (*request)(void* context, const uint8_t* pdu, uint8_t length, uint8_t* answer);
  /* The master has acknowledged an alarm. */
  void (*acknowledged)(void* context);
} xgate_application;

/* Set by xgate_open, may be changed after it. */
typedef struct xgate_settings {
  bool printed_errors;  /* errors have len 83H as in 4.5.1, not special bit 7 (X3) */
  bool short_mailboxes; /* without the byte `special` (X6) */
  uint8_t repetitions;  /* 2: of a command without a whole answer, or with an error of class 2 */
  uint16_t answer_ms;   /* 20: to the first byte of an answer */
  uint16_t byte_ms;     /* 5: between its bytes */
} xgate_settings;

/* 4.2, command 04. */
typedef struct xgate_config {
  uint8_t address; /* 0 to 126 */
  uint16_t ident;
  uint8_t inputs, outputs;
  uint8_t user_parameters; /* their number and 3; 0: none */
  uint8_t dpv1[XGATE_DPV1_BYTES];
  uint8_t cfg[XGATE_MAX_CFG];
  uint8_t cfg_length; /* 0: any configuration of the master; read it before data exchange (4.7.3) */
} xgate_config;

typedef struct xgate_pdu {
  uint8_t id, length;
  uint8_t bytes[XGATE_MAX_PDU];
} xgate_pdu;

typedef struct xgate_frame {
  uint8_t command, length, special;
  uint8_t data[XGATE_MAX_DATA];
} xgate_frame;

typedef struct xgate_module {
  xgate_port port;
  xgate_application application;
  xgate_settings settings;
  uint8_t error_class, error_code; /* of the last XGATE_ERR_MODULE */
  /* Private. */
  bool clear_acknowledged;
  bool parameters_due; /* the module has new ones, and they have not been read */
  xgate_frame command, answer;
  xgate_pdu queue[XGATE_QUEUE]; /* answers that have not left, oldest first */
  uint8_t queued;
} xgate_module;

xgate_result xgate_open(xgate_module* module, const xgate_port* port, const xgate_application* application);

/* Any command: its right answer is in module->answer. */
xgate_result xgate_command(xgate_module* module, uint8_t command, const uint8_t* data, uint8_t length);

xgate_result xgate_initialise(xgate_module* module, const xgate_config* config);

/* Commands 20, 30, 21, 22: inputs to the master, outputs of it. Requests and parameters of the master go to the
   application, its answers to the module. `length`: bytes of outputs. */
xgate_result xgate_exchange(xgate_module* module, const uint8_t* inputs, uint8_t size, uint8_t* outputs,
                            uint8_t capacity, uint8_t* length);

/* In the application's `request`: the id of the mailbox, by default 1 of C1, 2 of C2 (X7). */
uint8_t xgate_request_id(const xgate_module* module);

/* Command 31: an alarm or status block, then blocks of channels (4.4.3, 4.4.4); no bytes: no diagnosis. */
xgate_result xgate_diagnose(xgate_module* module, const uint8_t* blocks, uint8_t length);

/* Command 23: the master's configuration, in module->answer. */
xgate_result xgate_read_cfg(xgate_module* module);

/* For the files of this folder: a frame there and back, once. */
bool xgate_transfer(xgate_module* module);

#ifdef __cplusplus
}
#endif
/* NOLINTEND(modernize-deprecated-headers, modernize-use-using) */
#endif

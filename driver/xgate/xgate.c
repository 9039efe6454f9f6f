/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* Commands, and what a data exchange brings (4.5.1). */
#include "driver/xgate/xgate.h"

#include <string.h>

enum {
  kInitialise = 0x04,
  kStep = 0x13,
  kExchange = 0x20,
  kExchangeKnown = 0x21,
  kReadParameters = 0x22,
  kReadCfg = 0x23,
  kRequests = 0x30,
  kDiagnose = 0x31
};
enum { kOneSegment = 0x11, kAlarmFlag = 0x40, kErrorFlag = 0x80 };
enum { kLinkErrors = 2, kCfgAt = 19, kNegative = 0x80, kErrorDecode = 0x80, kInvalidIndex = 0xB0, kPduHead = 4 };

xgate_result xgate_open(xgate_module* module, const xgate_port* port, const xgate_application* application) {
  static const xgate_settings defaults = {false, false, 2u, 20u, 5u};
  if ((module == NULL) || (port == NULL) || (application == NULL) || (port->send == NULL) || (port->receive == NULL))
    return XGATE_ERR_ARGUMENT;
  (void)memset(module, 0, sizeof *module);
  module->port = *port;
  module->application = *application;
  module->settings = defaults;
  return XGATE_OK;
}

/* ----------------------------------------------------------------------------------------------- a command, repeated
 */

static bool answers(uint8_t command, uint8_t answer) {
  switch (command) {
    case kExchange: return (answer == kExchange) || (answer == kExchangeKnown) || (answer == kRequests);
    case kRequests:
    case kDiagnose: return answer == kExchange;
    case kStep: return (answer == kStep) || (answer == kInitialise); /* X15 */
    default: return answer == command;
  }
}

/* The module repeats the flag in each answer until a command has it (4.3.1). */
static void take_flag(xgate_module* module) {
  if ((module->answer.special & kAlarmFlag) == 0) return;
  module->clear_acknowledged = true;
  if (module->application.acknowledged != NULL) module->application.acknowledged(module->application.context);
}

static xgate_result once(xgate_module* module) {
  const bool clears = module->clear_acknowledged;
  xgate_frame* const answer = &module->answer;
  module->command.special = (uint8_t)(kOneSegment | (clears ? kAlarmFlag : 0));
  if (!xgate_transfer(module)) return XGATE_ERR_SILENT;
  if (clears) module->clear_acknowledged = false;
  take_flag(module);
  if ((answer->special & kErrorFlag) == 0)
    return answers(module->command.command, answer->command) ? XGATE_OK : XGATE_ERR_ANSWER;
  module->error_class = answer->data[0];
  module->error_code = answer->data[1];
  return XGATE_ERR_MODULE;
}

/* Repeats while the line, not the command, is at fault. */
static xgate_result repeat(xgate_module* module) {
  uint8_t left = module->settings.repetitions;
  xgate_result result = once(module);
  while ((left > 0u) && (result != XGATE_OK) &&
         ((result != XGATE_ERR_MODULE) || (module->error_class == kLinkErrors))) {
    --left;
    result = once(module);
  }
  return result;
}

xgate_result xgate_command(xgate_module* module, uint8_t command, const uint8_t* data, uint8_t length) {
  if ((module == NULL) || ((data == NULL) && (length > 0u))) return XGATE_ERR_ARGUMENT;
  module->command.command = command;
  module->command.length = length;
  if (length > 0u) (void)memmove(module->command.data, data, length);
  return repeat(module);
}

xgate_result xgate_initialise(xgate_module* module, const xgate_config* config) {
  uint8_t data[kCfgAt + XGATE_MAX_CFG];
  if ((module == NULL) || (config == NULL) || (config->cfg_length > XGATE_MAX_CFG)) return XGATE_ERR_ARGUMENT;
  data[0] = config->address;
  data[1] = (uint8_t)(config->ident & 0xFFu);
  data[2] = (uint8_t)(config->ident >> 8);
  data[3] = config->cfg_length;
  data[4] = config->inputs;
  data[5] = config->outputs;
  data[6] = config->user_parameters;
  (void)memcpy(&data[7], config->dpv1, XGATE_DPV1_BYTES);
  (void)memcpy(&data[kCfgAt], config->cfg, config->cfg_length);
  module->queued = 0;
  return xgate_command(module, kInitialise, data, (uint8_t)(kCfgAt + config->cfg_length));
}

xgate_result xgate_read_cfg(xgate_module* module) { return xgate_command(module, kReadCfg, NULL, 0); }

/* -------------------------------------------------------------------------------------------------------- mailboxes */

static uint8_t special_bytes(const xgate_module* module) { return (uint8_t)(module->settings.short_mailboxes ? 0 : 1); }

/* Appends a mailbox to the data of the command. False: it does not fit. */
static bool append(xgate_module* module, uint8_t id, const uint8_t* bytes, uint8_t length) {
  xgate_frame* const command = &module->command;
  uint8_t* to = &command->data[command->length];
  const uint16_t whole = (uint16_t)(2u + special_bytes(module) + length + 1u);
  uint8_t check = 0;
  uint16_t i;
  if (command->length + whole > XGATE_MAX_DATA) return false;
  *to++ = id;
  *to++ = length;
  if (special_bytes(module) > 0u) *to++ = 0u;
  for (i = 0; i < length; ++i) {
    to[i] = bytes[i];
    check = (uint8_t)(check ^ bytes[i]);
  }
  to[length] = check;
  command->length = (uint8_t)(command->length + whole);
  return true;
}

/* The application's answer to a request, at the end of the queue. */
static void serve(xgate_module* module, uint8_t id, const uint8_t* pdu, uint8_t length) {
  const xgate_application* const application = &module->application;
  xgate_pdu* const answer = &module->queue[module->queued];
  ++module->queued;
  answer->id = id;
  if (application->request != NULL) {
    answer->length = application->request(application->context, pdu, length, answer->bytes);
    if (answer->length == 0u) --module->queued;
    return;
  }
  answer->bytes[0] = (uint8_t)(pdu[0] | kNegative);
  answer->bytes[1] = kErrorDecode;
  answer->bytes[2] = kInvalidIndex;
  answer->bytes[3] = 0u;
  answer->length = kPduHead;
}

uint8_t xgate_request_id(const xgate_module* module) {
  return ((module == NULL) || (module->queued == 0u)) ? 0u : module->queue[module->queued - 1u].id;
}

/* The requests of an answer 30, oldest first. One that is damaged or does not fit is shown again (X24). */
static void serve_all(xgate_module* module) {
  const xgate_frame* const answer = &module->answer;
  const uint16_t before = (uint16_t)(2u + special_bytes(module));
  uint16_t at = 0;
  while ((at + before < answer->length) && (module->queued < XGATE_QUEUE)) {
    const uint8_t* const box = &answer->data[at];
    const uint16_t whole = (uint16_t)(before + box[1] + 1u);
    uint8_t check = 0;
    uint16_t i;
    if ((at + whole > answer->length) || (box[1] < kPduHead)) return;
    for (i = 2; i < whole; ++i) check = (uint8_t)(check ^ box[i]);
    if (check == 0u) serve(module, box[0], &box[before], box[1]);
    at = (uint16_t)(at + whole);
  }
}

/* Command 30 with as many answers as it holds. The module shows a request again whose answer it has not taken. */
static xgate_result give_answers(xgate_module* module) {
  uint8_t sent = 0;
  module->command.command = kRequests;
  module->command.length = 0;
  while ((sent < module->queued) &&
         append(module, module->queue[sent].id, module->queue[sent].bytes, module->queue[sent].length))
    ++sent;
  (void)memmove(&module->queue[0], &module->queue[sent], (size_t)(module->queued - sent) * sizeof module->queue[0]);
  module->queued = (uint8_t)(module->queued - sent);
  return repeat(module);
}

/* ---------------------------------------------------------------------------------------------------- data exchange */

static void copy_outputs(const xgate_frame* answer, uint8_t* outputs, uint8_t capacity, uint8_t* length) {
  *length = answer->length;
  (void)memcpy(outputs, answer->data, (answer->length < capacity) ? answer->length : capacity);
}

static xgate_result read_parameters(xgate_module* module) {
  const xgate_result result = xgate_command(module, kReadParameters, NULL, 0);
  const xgate_application* const application = &module->application;
  if (result != XGATE_OK) return result;
  module->parameters_due = false;
  if (application->parameters != NULL)
    application->parameters(application->context, module->answer.data, module->answer.length);
  return XGATE_OK;
}

xgate_result xgate_exchange(xgate_module* module, const uint8_t* inputs, uint8_t size, uint8_t* outputs,
                            uint8_t capacity, uint8_t* length) {
  xgate_result result;
  if ((module == NULL) || (outputs == NULL) || (length == NULL)) return XGATE_ERR_ARGUMENT;
  *length = 0;
  result = xgate_command(module, kExchange, inputs, size);
  if ((result == XGATE_OK) && (module->answer.command == kRequests)) {
    module->queued = 0;
    serve_all(module);
    while ((result == XGATE_OK) && (module->queued > 0u)) result = give_answers(module);
  }
  /* 21 clears the module's flag. It goes before 22: newer parameters set it again. While requests stay open 20 brings
     no outputs, 21 does; whether there are new parameters is not to be seen then (X24). */
  if ((result == XGATE_OK) && ((module->answer.command == kExchangeKnown) || (module->answer.command == kRequests))) {
    module->parameters_due = true;
    result = xgate_command(module, kExchangeKnown, inputs, size);
  }
  if (result != XGATE_OK) return result;
  copy_outputs(&module->answer, outputs, capacity, length);
  return module->parameters_due ? read_parameters(module) : XGATE_OK;
}

xgate_result xgate_diagnose(xgate_module* module, const uint8_t* blocks, uint8_t length) {
  enum { kDiagnosisId = 3 };
  if ((module == NULL) || ((blocks == NULL) && (length > 0u))) return XGATE_ERR_ARGUMENT;
  module->command.command = kDiagnose;
  module->command.length = 0;
  return append(module, kDiagnosisId, blocks, length) ? repeat(module) : XGATE_ERR_ARGUMENT;
}

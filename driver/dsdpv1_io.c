/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* Cyclic data and diagnosis. */
#include "dsdpv1_internal.h"

static const dsdpv1_area kOutputs = {DSDPV1_REG_OUTPUT,         1,
                                     DSDPV1_REG_OUTPUT_CRC,     DSDPV1_REG_USER_STATUS_2_OUTPUT_CRC,
                                     DSDPV1_ERR_OUTPUT_LENGTH,  DSDPV1_ERR_OUTPUT_CRC,
                                     DSDPV1_REG_CHIP_COMMAND_1, DSDPV1_REG_CHIP_COMMAND_1_OUTPUT};

/* Inside a hold. The length byte is the block's head. */
static void write_inputs(dsdpv1_device* device, const dsdpv1_block* inputs, uint8_t command) {
  dsdpv1_put_block(device, inputs);
  dsdpv1_announce(device, DSDPV1_REG_USER_COMMAND_1, command, 0, DSDPV1_REG_USER_COMMAND_1_INPUT);
}

/*
 * Inside a hold. Sets result->inputs_written, and `fetched` if the same telegram also brought new outputs. Returns
 * the chip's verdict on the previous inputs (B00B.2).
 */
static dsdpv1_error give_inputs(dsdpv1_device* device, dsdpv1_input_policy policy, const dsdpv1_block* inputs,
                                dsdpv1_exchange_result* result, dsdpv1_copy* outputs, bool* fetched) {
  const uint8_t command = dsdpv1_get(device, DSDPV1_REG_USER_COMMAND_1);
  const uint8_t status = dsdpv1_get(device, DSDPV1_REG_CHIP_STATUS_2);
  if (policy == DSDPV1_INPUT_NEWEST || (command & DSDPV1_REG_USER_COMMAND_1_INPUT) == 0u) {
    if (device->link->exchange == NULL || outputs->data == NULL)
      write_inputs(device, inputs, command);
    else if (device->fault == DSDPV1_OK)
      device->fault = device->link->exchange(device, inputs, outputs, fetched);
    result->inputs_written = device->fault == DSDPV1_OK;
  }
  return (status & DSDPV1_REG_CHIP_STATUS_2_INPUT_CRC) != 0u ? DSDPV1_ERR_INPUT_CRC : DSDPV1_OK;
}

/* Inside a hold. Returns true if there were new outputs. */
static bool take_outputs(dsdpv1_device* device, dsdpv1_exchange_result* result, dsdpv1_copy* copy) {
  const uint8_t command = dsdpv1_get(device, DSDPV1_REG_CHIP_COMMAND_1);
  result->intr0_missed = (command & (DSDPV1_REG_CHIP_COMMAND_1_PRM | DSDPV1_REG_CHIP_COMMAND_1_CFG)) != 0u;
  if (copy->data == NULL || (command & DSDPV1_REG_CHIP_COMMAND_1_OUTPUT) == 0u) return false;
  dsdpv1_before_fetch(device, DSDPV1_REG_CHIP_COMMAND_1, DSDPV1_REG_CHIP_COMMAND_1_OUTPUT);
  dsdpv1_fetch(device, &kOutputs, copy);
  dsdpv1_after_fetch(device, DSDPV1_REG_CHIP_COMMAND_1, command, DSDPV1_REG_CHIP_COMMAND_1_OUTPUT);
  return true;
}

static dsdpv1_copy output_copy(const dsdpv1_exchange_result* result) {
  const dsdpv1_copy copy = {
      {0}, result->outputs, result->capacity < DSDPV1_MAX_IO ? result->capacity : (uint8_t)DSDPV1_MAX_IO, 0};
  return copy;
}

static dsdpv1_error check_exchange(const dsdpv1_device* device, const uint8_t* inputs, uint8_t input_length,
                                   const dsdpv1_exchange_result* result) {
  if (device == NULL || result == NULL) return DSDPV1_ERR_ARGUMENT;
  if (!device->initialised) return DSDPV1_ERR_NOT_INITIALISED;
  return inputs != NULL && input_length > device->max_input ? DSDPV1_ERR_INPUT_LENGTH : DSDPV1_OK;
}

dsdpv1_error dsdpv1_exchange(dsdpv1_device* device, dsdpv1_input_policy policy, const uint8_t* inputs,
                             uint8_t input_length, dsdpv1_exchange_result* result) {
  dsdpv1_error error = check_exchange(device, inputs, input_length, result);
  if (error != DSDPV1_OK) return error;
  const uint8_t no_inputs = 0;
  dsdpv1_block block = {DSDPV1_REG_INPUT_LENGTH, {&input_length, 1}, {&no_inputs, 0}, DSDPV1_REG_INPUT_CRC, 0};
  block.crc = dsdpv1_crc_byte(DSDPV1_CRC_START, input_length);
  if (inputs != NULL) {
    block.data.bytes = inputs;
    block.data.length = input_length;
    block.crc = dsdpv1_crc(block.crc, inputs, input_length);
  }
  dsdpv1_copy copy = output_copy(result);
  result->inputs_written = false;
  result->outputs_new = false;

  error = dsdpv1_hold(device);
  if (error != DSDPV1_OK) return error;
  bool fetched = false;
  const dsdpv1_error input_error =
      inputs != NULL ? give_inputs(device, policy, &block, result, &copy, &fetched) : DSDPV1_OK;
  if (take_outputs(device, result, &copy)) fetched = true;
  error = dsdpv1_release(device);
  if (error != DSDPV1_OK) return error;

  if (fetched) {
    error = dsdpv1_confirm(device, &kOutputs, &copy);
    result->outputs_new = error == DSDPV1_OK;
    result->length = dsdpv1_copy_length(&kOutputs, &copy);
  }
  return error != DSDPV1_OK ? error : input_error;
}

/* ----------------------------------------------------------------------------------------------------- input errors */

/* In a separate hold; C1 and C2 answers waiting in B011 stay. */
static dsdpv1_error change_user_command_2(dsdpv1_device* device, unsigned clear, unsigned set) {
  const dsdpv1_error error = dsdpv1_hold(device);
  if (error != DSDPV1_OK) return error;
  const uint8_t command = dsdpv1_get(device, DSDPV1_REG_USER_COMMAND_2);
  dsdpv1_announce(device, DSDPV1_REG_USER_COMMAND_2, command, (uint8_t)clear, (uint8_t)set);
  return dsdpv1_release(device);
}

dsdpv1_error dsdpv1_keep_input_errors(dsdpv1_device* device, bool keep) {
  const unsigned history = DSDPV1_REG_USER_COMMAND_2_INPUT_HISTORY;
  return device == NULL ? DSDPV1_ERR_ARGUMENT : change_user_command_2(device, history, keep ? history : 0u);
}

dsdpv1_error dsdpv1_clear_input_error(dsdpv1_device* device) {
  return device == NULL ? DSDPV1_ERR_ARGUMENT
                        : change_user_command_2(device, 0u, DSDPV1_REG_USER_COMMAND_2_INPUT_CLEAR);
}

/* -------------------------------------------------------------------------------------------------------- diagnosis */

static bool type_is_known(dsdpv1_diag_type type) { /* D9 */
  return type == DSDPV1_DIAG_EXTENDED || type == DSDPV1_DIAG_EXTERNAL || type == DSDPV1_DIAG_EXTERNAL_GONE ||
         type == DSDPV1_DIAG_STATIC || type == DSDPV1_DIAG_STATIC_GONE;
}

static dsdpv1_error check_diagnosis(const dsdpv1_device* device, dsdpv1_diag_type type, const uint8_t* data,
                                    uint8_t length) {
  if (device == NULL || (data == NULL && length != 0u)) return DSDPV1_ERR_ARGUMENT;
  if (!device->initialised) return DSDPV1_ERR_NOT_INITIALISED;
  if (!type_is_known(type)) return DSDPV1_ERR_DIAG_TYPE;
  return length > device->max_diag ? DSDPV1_ERR_DIAG_LENGTH : DSDPV1_OK;
}

static dsdpv1_error write_diagnosis(dsdpv1_device* device, const dsdpv1_block* block) {
  const dsdpv1_error error = dsdpv1_hold(device);
  if (error != DSDPV1_OK) return error;
  if (device->link->post != NULL) {
    device->fault = device->link->post(device, block);
  } else {
    dsdpv1_put_block(device, block);
    const uint8_t command = dsdpv1_get(device, DSDPV1_REG_USER_COMMAND_1);
    dsdpv1_announce(device, DSDPV1_REG_USER_COMMAND_1, command, 0, DSDPV1_REG_USER_COMMAND_1_DIAG);
  }
  return dsdpv1_release(device);
}

static dsdpv1_error diagnosis_answer(dsdpv1_device* device) {
  dsdpv1_error error = dsdpv1_hold_when_taken(device, DSDPV1_REG_USER_COMMAND_1_DIAG, DSDPV1_ERR_DIAG_TIMEOUT);
  if (error != DSDPV1_OK) return error;
  const uint8_t status = dsdpv1_get(device, DSDPV1_REG_CHIP_STATUS_2);
  error = dsdpv1_release(device);
  if (error != DSDPV1_OK) return error;
  return (status & DSDPV1_REG_CHIP_STATUS_2_DIAG_CRC) != 0u ? DSDPV1_ERR_DIAG_CRC : DSDPV1_OK;
}

dsdpv1_error dsdpv1_set_diagnosis(dsdpv1_device* device, dsdpv1_diag_type type, const uint8_t* data, uint8_t length) {
  dsdpv1_error error = check_diagnosis(device, type, data, length);
  if (error != DSDPV1_OK) return error;
  const uint8_t head[2] = {(uint8_t)type, length};
  const uint16_t crc = dsdpv1_crc(dsdpv1_crc(DSDPV1_CRC_START, head, 2), data, length); /* D3: from B227 */
  const dsdpv1_block block = {DSDPV1_REG_DIAG, {head, sizeof head}, {data, length}, DSDPV1_REG_DIAG_CRC, crc};
  for (uint8_t retries = device->tuning.crc_retries;; --retries) {
    error = write_diagnosis(device, &block);
    if (error == DSDPV1_OK) error = diagnosis_answer(device);
    if (error != DSDPV1_ERR_DIAG_CRC || retries == 0u) return error;
  }
}

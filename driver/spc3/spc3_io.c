/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 OR MIT */
/* Inputs, outputs and diagnosis: the user's buffer is written or read, and a command hands it over (5.2.4, 5.2.5). */
#include "spc3_internal.h"

spc3_error spc3_set_inputs(spc3_device* device, const uint8_t* bytes, uint8_t length) {
  if (device == NULL || (bytes == NULL && length != 0u)) return SPC3_ERR_ARGUMENT;
  if (length != spc3_get(device, SPC3_REG_ORG_DIN_LENGTH)) return SPC3_ERR_INPUT_LENGTH;
  if (length == 0u) return SPC3_OK;
  const uint16_t user = (uint16_t)((spc3_get(device, SPC3_REG_DIN_SM) & SPC3_REG_SM_U) >> SPC3_REG_SM_U_SHIFT);
  spc3_put_bytes(device, spc3_buffer(device, (uint16_t)(SPC3_REG_ORG_DIN_POINTER + user - 1u)), bytes, length);
  (void)spc3_get(device, SPC3_REG_NEW_DIN);
  return SPC3_OK;
}

spc3_error spc3_get_outputs(spc3_device* device, spc3_outputs* outputs) {
  if (device == NULL || outputs == NULL || outputs->bytes == NULL) return SPC3_ERR_ARGUMENT;
  const uint8_t length = spc3_get(device, SPC3_REG_ORG_DOUT_LENGTH);
  outputs->fresh = false;
  if (length > outputs->capacity) return SPC3_ERR_OUTPUT_LENGTH;
  const uint16_t next = spc3_get(device, SPC3_REG_NEXT_DOUT);
  if ((next & SPC3_REG_NEXT_DOUT_FRESH) == 0u) return SPC3_OK;
  const uint16_t pointer = (uint16_t)(SPC3_REG_ORG_DOUT_POINTER + (next & SPC3_REG_NEXT_DOUT_U) - 1u);
  spc3_get_bytes(device, spc3_buffer(device, pointer), outputs->bytes, length);
  outputs->length = length;
  outputs->fresh = true;
  outputs->cleared = (next & SPC3_REG_NEXT_DOUT_CLEARED) != 0u;
  return SPC3_OK;
}

/* Which of the two the user has: 0, 1; 2 if the chip has both. */
static uint16_t user_diagnosis(const spc3_device* device) {
  const uint8_t owners = spc3_get(device, SPC3_REG_DIAG_SM);
  if ((owners & SPC3_REG_DIAG_SM_FIRST) == SPC3_REG_DIAG_OWNER_USER) return 0;
  return ((owners & SPC3_REG_DIAG_SM_SECOND) >> SPC3_REG_DIAG_SM_SECOND_SHIFT) == SPC3_REG_DIAG_OWNER_USER ? 1u : 2u;
}

spc3_error spc3_set_diagnosis(spc3_device* device, uint8_t flags, const uint8_t* bytes, uint8_t length) {
  if (device == NULL || (bytes == NULL && length != 0u)) return SPC3_ERR_ARGUMENT;
  if (length > device->max_diag) return SPC3_ERR_DIAG_LENGTH;
  const uint16_t user = user_diagnosis(device);
  if (user > 1u) return SPC3_ERR_DIAG_BUSY;
  const uint16_t buffer = spc3_buffer(device, (uint16_t)(SPC3_REG_ORG_DIAG_POINTER + user));
  spc3_put(device, buffer, flags); /* the chip writes the other standard bytes (A39) */
  spc3_put_bytes(device, (uint16_t)(buffer + kDiagHead), bytes, length);
  spc3_put(device, (uint16_t)(SPC3_REG_ORG_DIAG_LENGTH + user), (uint8_t)(kDiagHead + length));
  (void)spc3_get(device, SPC3_REG_NEW_DIAG);
  return SPC3_OK;
}

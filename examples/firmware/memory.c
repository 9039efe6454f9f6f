/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/*
 * memcpy and its relatives. Compiled with -fno-tree-loop-distribute-patterns, because otherwise the compiler would
 * replace the loops by calls of the same functions.
 */
#include <stdint.h>
#include <string.h>

void* memcpy(void* restrict to, const void* restrict from, size_t size) {
  uint8_t* target = to;
  const uint8_t* source = from;
  while (size-- != 0u) *target++ = *source++;
  return to;
}

void* memmove(void* to, const void* from, size_t size) {
  uint8_t* target = to;
  const uint8_t* source = from;
  if ((uintptr_t)target <= (uintptr_t)source) return memcpy(to, from, size);
  while (size-- != 0u) target[size] = source[size];
  return to;
}

void* memset(void* to, int value, size_t size) {
  uint8_t* target = to;
  while (size-- != 0u) *target++ = (uint8_t)value;
  return to;
}

int memcmp(const void* a, const void* b, size_t size) {
  const uint8_t* left = a;
  const uint8_t* right = b;
  for (size_t i = 0; i < size; ++i)
    if (left[i] != right[i]) return left[i] < right[i] ? -1 : 1;
  return 0;
}

size_t strlen(const char* text) {
  size_t length = 0;
  while (text[length] != '\0') ++length;
  return length;
}

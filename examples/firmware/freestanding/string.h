/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef FREESTANDING_STRING_H
#define FREESTANDING_STRING_H
/* For a build without a C library: the four functions that a compiler may call implicitly, and strlen. In memory.c. */
#include <stddef.h>

void* memcpy(void* restrict to, const void* restrict from, size_t size);
void* memmove(void* to, const void* from, size_t size);
void* memset(void* to, int value, size_t size);
int memcmp(const void* a, const void* b, size_t size);
size_t strlen(const char* text);

#endif /* FREESTANDING_STRING_H */

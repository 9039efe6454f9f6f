/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef CONSOLE_H
#define CONSOLE_H
/*
 * Lines of text on USART1, 115200 8N1. Output never blocks: text goes into a buffer and is lost if that is full.
 * From the main loop only.
 */
#include <stdbool.h>
#include <stdint.h>

void console_start(void);
void console_text(const char* text);
void console_decimal(uint32_t value);
void console_hex(uint32_t value, unsigned digits);
/* Sends a character if the line is free. Call it often. */
void console_poll(void);
/* True while there is something to send. */
bool console_busy(void);

#endif /* CONSOLE_H */

/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef CONSOLE_H
#define CONSOLE_H
/*
 * Lines of text on USART1, 115200 8N1. Nobody waits for the slow line: text goes into a buffer, and what finds it full
 * is lost. From the main loop only.
 */
#include <stdbool.h>
#include <stdint.h>

void console_start(void);
void console_text(const char* text);
void console_decimal(uint32_t value);
void console_hex(uint32_t value, unsigned digits);
/* Sends a character when the line is free. To be called often. */
void console_poll(void);
/* True while there is something to send. */
bool console_busy(void);

#endif /* CONSOLE_H */

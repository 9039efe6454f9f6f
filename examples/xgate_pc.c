/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
/* A host program on a PC: driver/xgate at a serial port. The port is that of a module, by an adapter for USB, or the
   pseudo-terminal of `dsdpv1-sim serve SCENARIO --user-pty NAME` (docs/xgate.md).

     xgate_pc PORT [EXCHANGES]

   It gives the module address 8, 2 bytes of inputs and 2 of outputs, sends the outputs back as inputs, and prints them
   when they change. */
#define _DEFAULT_SOURCE /* cfmakeraw */
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

#include "driver/xgate/xgate.h"

static int open_port(const char* path) {
  struct termios settings;
  const int fd = open(path, O_RDWR | O_NOCTTY);
  if (fd < 0 || tcgetattr(fd, &settings) != 0) return -1;
  cfmakeraw(&settings); /* 8 bits, no parity */
  cfsetspeed(&settings, B115200);
  return tcsetattr(fd, TCSANOW, &settings) == 0 ? fd : -1;
}

static void send_bytes(void* context, const uint8_t* bytes, uint16_t length) {
  ssize_t written = 0;
  while (length > 0 && (written = write(*(const int*)context, bytes, length)) > 0) {
    bytes += written;
    length = (uint16_t)(length - written);
  }
}

static int receive_byte(void* context, uint16_t ms) {
  struct pollfd port = {*(const int*)context, POLLIN, 0};
  uint8_t byte = 0;
  if (poll(&port, 1, ms) <= 0 || read(port.fd, &byte, 1) != 1) return -1;
  return byte;
}

int main(int argc, char** argv) {
  const xgate_config config = {
      .address = 8, .ident = 0x0F01, .inputs = 2, .outputs = 2, .cfg = {0x11, 0x21}, .cfg_length = 2};
  uint8_t process[XGATE_MAX_DATA] = {0}, last[2] = {0};
  long left = argc > 2 ? strtol(argv[2], NULL, 10) : -1; /* -1: no end */
  int fd = argc > 1 ? open_port(argv[1]) : -1;
  const xgate_port port = {&fd, send_bytes, receive_byte};
  const xgate_application none = {NULL, NULL, NULL, NULL}; /* requests of C1 and C2 are refused */
  xgate_module module;
  if (fd < 0) {
    fprintf(stderr, "xgate_pc: expected a serial port\n");
    return 2;
  }
  xgate_open(&module, &port, &none);
  module.settings.answer_ms = 200; /* a PC is late at times */
  module.settings.byte_ms = 100;
  while (xgate_initialise(&module, &config) != XGATE_OK) usleep(10000);
  printf("initialised\n");
  while (left != 0) {
    uint8_t length = 0;
    const xgate_result result = xgate_exchange(&module, process, 2, process, sizeof process, &length);
    if (result == XGATE_OK && length == 2) {
      if (memcmp(process, last, 2) != 0) printf("outputs %02X %02X\n", process[0], process[1]);
      memcpy(last, process, 2);
      if (left > 0) --left;
    } else if (result == XGATE_ERR_MODULE) {
      usleep(10000); /* 3/3 or 3/4: no master has parameterised it yet */
    } else {
      fprintf(stderr, "xgate_pc: no answer of the module: %d\n", (int)result);
      return 1;
    }
    fflush(stdout);
  }
  return 0;
}

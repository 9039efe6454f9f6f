#ifndef PIN_BY_PIN_H
#define PIN_BY_PIN_H
/* A chip driven pin by pin from C, compiled as C99. */
#include "dsdpv1/dsdpv1.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Releases RESET at `released`, waits for the start-up, takes the DPRAM, reads B004 and releases the DPRAM.
 * `changes` receives at most `capacity` changes of the outputs; returns their number, 0 after an error. */
size_t drive_pin_by_pin(uint64_t released, dpsim_change* changes, size_t capacity);

#ifdef __cplusplus
}
#endif
#endif

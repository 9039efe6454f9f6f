/* SPDX-FileCopyrightText: 2026 the dsdpv1 authors */
/* SPDX-License-Identifier: Apache-2.0 */
#ifndef FAULTS_H
#define FAULTS_H
/*
 * Faults of firmware, one for each build of this folder: -DPLANTED=NAME.
 *
 *   X(name, ports, kind, what)
 *   ports: P parallel, S SPI, U UART
 *   kind: ACT, the run names the line marked TELLS(name); OMISSION, the function in which the firmware is instead
 * (owed.py), or a marked line; SILENT: no observer can know, `what` says why
 */
#define FAULT_TABLE(X)                                                                                          \
  X(NONE, "PSU", RIGHT, "right firmware")                                                                       \
  /* the handshake */                                                                                           \
  X(STA_UNLOOKED, "P", ACT, "R_STA is raised without a look at L_REQ and L_STA")                                \
  X(LOOK_EARLY, "P", ACT, "the only look comes within three cycles of R_REQ")                                   \
  X(REQ_LEFT_UP, "PS", OMISSION, "R_REQ, or B014.1, stays up for 12 ms")                                        \
  X(HELD_ALWAYS, "PS", OMISSION, "the DPRAM is held nearly all the time")                                       \
  X(UNCOUNTED, "P", ACT, "B006 is not counted")                                                                 \
  X(RELEASE_EARLY, "P", ACT, "R_STA falls before the last cell is written")                                     \
  /* blocks of the chip */                                                                                      \
  X(WRONG_FLAG, "PS", OMISSION, "B00F is cleared instead of B00E")                                              \
  X(CLEARED_UNREAD, "PS", ACT, "B00E.0 is cleared without reading the outputs")                                 \
  X(NEVER_CLEARED, "PS", OMISSION, "B00E.0 is never cleared")                                                   \
  X(OUTPUTS_NEVER, "PS", OMISSION, "outputs are never fetched")                                                 \
  X(OUTPUTS_RARELY, "PS", SILENT, "outputs are fetched in each fortieth turn: a device may be slow (U4)")       \
  X(OUTPUTS_LATE, "PS", ACT, "outputs are copied in one hold, the flag is cleared in the next")                 \
  X(LENGTH_UNREAD, "PS", ACT, "the length byte of the outputs is not read")                                     \
  X(OUTPUT_CRC_UNREAD, "P", ACT, "the CRC of the outputs is not read")                                          \
  X(PRM_CRC_UNREAD, "P", ACT, "the CRC of the parameters is not read")                                          \
  X(CRC_UNJUDGED, "PSU", ACT, "CRCs of blocks, over SPI and UART of telegrams, are read and not judged")        \
  /* blocks of the user */                                                                                      \
  X(CRC_LATE, "P", ACT, "the CRC of the inputs is written a hold late")                                         \
  X(CRC_EXCHANGED, "P", ACT, "the bytes of the inputs' CRC are exchanged")                                      \
  X(INPUTS_IN_TWO, "P", ACT, "inputs are written in two holds, the flag is set in the first")                   \
  X(INPUT_FLAG_NEVER, "PS", OMISSION, "B010.0 is never set")                                                    \
  X(INPUTS_ONCE, "PS", OMISSION, "inputs are written once")                                                     \
  X(INIT_EARLY, "PSU", ACT, "the chip is initialised before B004 is C5")                                        \
  X(INIT_EACH_TURN, "PSU", ACT, "the initialisation's flag is set in each turn")                                \
  X(IDENT_EXCHANGED, "PSU", ACT, "the bytes of the ident number are exchanged")                                 \
  X(DIAGNOSIS_LONG, "PSU", ACT, "a diagnosis is longer than B029")                                              \
  X(STATIC_STAYS, "PSU", SILENT, "static diagnosis is never taken back: a device may have a fault for ever")    \
  /* verdicts */                                                                                                \
  X(NO_VERDICT, "PSU", OMISSION, "Set_Prm gets no verdict")                                                     \
  X(VERDICT_LATE, "PSU", OMISSION, "the verdict comes 150 ms late")                                             \
  X(VERDICT_ALWAYS, "PSU", ACT, "verdicts are set in each turn, without a look at B00E")                        \
  X(VERDICT_CACHED, "PSU", ACT, "each configuration gets the verdict on the first one")                         \
  X(CFG_ACCEPTED, "PSU", ACT, "every configuration is accepted, also one of four bytes in")                     \
  /* interrupts and the main loop */                                                                            \
  X(INTR0_BY_LEVEL, "P", OMISSION, "INTR0 is polled by its level between turns")                                \
  X(INTR0_IGNORED, "PS", OMISSION, "INTR0 is ignored")                                                          \
  X(EDGE_UNSET, "PS", OMISSION, "the falling edge of INTR0's EXTI line is never set up")                        \
  X(UNACKNOWLEDGED, "PSU", OMISSION, "the EXTI line is never acknowledged")                                     \
  X(INTERRUPTS_OFF, "PSU", OMISSION, "interrupts are off, and the main loop waits, for 150 ms")                 \
  X(LOOP_DEAD, "PSU", OMISSION, "the main loop ends after a hundred turns")                                     \
  /* acyclic */                                                                                                 \
  X(C1_WRONG_SLOT, "PSU", ACT, "a C1 read is answered for another slot")                                        \
  X(C1_LONG, "PSU", ACT, "a C1 read is answered with more than was asked for")                                  \
  X(C1_UNPOLLED, "PSU", OMISSION, "C1 requests are never looked for")                                           \
  X(REQUEST_DROPPED, "U", OMISSION, "a C1 request that came with inputs' reply is forgotten")                   \
  X(ANSWER_STALE, "PS", ACT, "an answer is given after 20 ms, without a look whether a newer request has come") \
  X(C2_FLAG_LOST, "PSU", OMISSION, "B00F.1 is cleared together with B00F.0, unread")                            \
  /* RESET */                                                                                                   \
  X(RESET_SHORT, "PSU", SILENT, "RESET is low from one store to the next: no document has a least time (U10)")  \
  X(RESET_UNDRIVEN, "PSU", ACT, "RESET's pin stays an input")                                                   \
  /* the board */                                                                                               \
  X(FSMC_UNCLOCKED, "P", ACT, "the FSMC has no clock")                                                          \
  X(GPIO_UNCLOCKED, "PSU", ACT, "port C, or A, has no clock")                                                   \
  X(FSMC_MULTIPLEXED, "P", ACT, "the FSMC multiplexes address and data")                                        \
  X(FSMC_WIDE, "P", ACT, "the FSMC's bus is 16 bits wide")                                                      \
  X(FSMC_FLOATING, "P", ACT, "the pins of the FSMC are inputs")                                                 \
  X(NO_WAIT_STATES, "PSU", ACT, "72 MHz without wait states of the flash")                                      \
  X(OPEN_DRAIN, "P", ACT, "R_REQ and R_STA are open drain")                                                     \
  X(ALTERNATE, "P", ACT, "R_REQ and R_STA are pins of another function")                                        \
  X(DRIVES_L, "P", ACT, "L_REQ and L_STA are outputs")                                                          \
  X(NOT_VOLATILE, "P", ACT, "the DPRAM is not volatile")                                                        \
  X(STRAY_STORE, "PSU", ACT, "a store through a pointer that is null and an offset")                            \
  X(OVERRUN, "SU", ACT, "the receiver is read too late")                                                        \
  X(TELEGRAM_CRC, "SU", ACT, "a telegram has a wrong CRC")                                                      \
  X(CHIPS_FLAG, "PSU", ACT, "a flag is set that only the chip sets")

enum fault {
#define FAULT_NAME(name, ports, kind, what) name,
  FAULT_TABLE(FAULT_NAME)
#undef FAULT_NAME
};

#ifndef PLANTED
#define PLANTED NONE
#endif
#define HAS(fault) (PLANTED == (fault))

#endif /* FAULTS_H */

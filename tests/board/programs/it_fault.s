@ A load fails inside of an IT block; the handler mends its address and returns to it.
        .include "vectors.inc"
function main
        control 0xD24, 1 << 17          @ SHCSR: BusFault has a handler
        ldr     r3, =0x90000000
        movs    r4, #0
        movs    r5, #0
        movs    r6, #1                  @ not zero: NE
        itete   ne
        movne   r4, #1
        moveq   r5, #1
        ldrne   r4, [r3]
        addeq   r5, #2
        exit
function bus_fault
        ldr     r0, [sp, #28]           @ xPSR
        ldr     r1, =0x0600FC00
        ands    r0, r1
        ldr     r1, =PORT
        str     r0, [r1]
        ldr     r0, =0x20000200
        movs    r1, #42
        str     r1, [r0]
        str     r0, [sp, #12]           @ r3
        ldr     r0, =SCS + 0xD28
        ldr     r1, [r0]
        str     r1, [r0]                @ BFSR
        bx      lr

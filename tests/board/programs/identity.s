@ What the system control block tells, and STIR; byte writes to the priority registers.
        .include "vectors.inc"
function main
        ldr     r0, =SCS
        ldr     r1, =0xD00
        ldr     r2, [r0, r1]
        ldr     r3, [r0, #4]
        control 0x100, 2
        ldr     r0, =SCS + 0xD1F
        movs    r1, #0xFF
        strb    r1, [r0]
        ldr     r4, [r0, #-3]
        ldrb    r5, [r0]
        ldrh    r6, [r0, #-1]
        control 0xF00, 1
        ldr     r0, =SCS + 0xD04
        ldr     r8, [r0]
        ldr     r7, =0xE0042000
        ldr     r7, [r7]
        exit
function irq1
        ldr     r0, =SCS + 0xD04
        ldr     r9, [r0]
        ldr     r0, =SCS + 0x300
        ldr     r10, [r0]
        bx      lr

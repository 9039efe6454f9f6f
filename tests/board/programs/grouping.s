@ With AIRCR.PRIGROUP 7 no priority preempts, but it orders; the write without the key has no effect.
        .include "vectors.inc"
function main
        control 0x400, 0x00206080
        control 0x100, 7
        control 0xD0C, 0x12340700
        ldr     r2, [r0]
        ldr     r0, =PORT
        str     r2, [r0]
        control 0xD0C, 0x05FA0700
        ldr     r2, [r0]
        ldr     r0, =PORT
        str     r2, [r0]
        control 0x200, 1
        exit
function irq0
        note    10
        control 0x200, 6
        note    11
        bx      lr
function irq1
        note    20
        bx      lr
function irq2
        note    30
        bx      lr

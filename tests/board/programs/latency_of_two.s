@ Interrupts 0 and 1, of which 0 goes first. Each handler begins with the store that is noted.
        .include "vectors.inc"
function main
        control 0x100, 3
        control 0x400, 0x1000
        ldr     r2, =PORT
        mov     r3, #10
        mov     r4, #11
        str     r3, [r2]
        mov     r5, #200
1:      subs    r5, #1
        bne     1b
        exit
function irq0
        str     r3, [r2]
        bx      lr
function irq1
        str     r4, [r2]
        bx      lr

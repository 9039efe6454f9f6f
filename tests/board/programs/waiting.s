@ Counts in r2 until the handler of interrupt 0 has come as often as the word at 0x20000100 says.
        .include "vectors.inc"
function main
        movs    r7, #0
        ldr     r4, =0x20000100
        ldr     r4, [r4]
        control 0x100, 3
        note    1
        movs    r2, #0
1:      adds    r2, #1
        cmp     r7, r4
        blt     1b
        note    2
        exit
function irq0
        adds    r7, #1
        ldr     r0, =PORT
        str     r7, [r0]
        bx      lr
function irq1
        note    11
        bx      lr

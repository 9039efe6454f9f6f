@ DWT.CYCCNT counts once DEMCR.TRCENA and its own bit are set.
        .include "vectors.inc"
function main
        ldr     r2, =0xE0001000
        ldr     r3, [r2, #4]
        control 0xDFC, 0x01000000
        movs    r1, #1
        str     r1, [r2]
        ldr     r4, [r2, #4]
        nop
        nop
        ldr     r5, [r2, #4]
        movs    r1, #100
        str     r1, [r2, #4]
        ldr     r6, [r2, #4]
        ldr     r7, [r2]
        exit

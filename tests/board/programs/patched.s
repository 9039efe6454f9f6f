@ Calls a routine in flash and one in RAM again and again; the bench changes both in between.
        .include "vectors.inc"
function main
        ldr     r5, =0x20000201
        ldr     r6, =PORT
1:      bl      routine
        str     r0, [r6]
        blx     r5
        str     r0, [r6]
        b       1b
        .balign 16
        .global routine
function routine
        movs    r0, #1
        bx      lr

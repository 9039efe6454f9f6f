@ A load from PORT, then for ever a loop of five instructions in the manner of compiled code.
        .include "vectors.inc"
function main
        ldr     r0, =PORT
        ldr     r1, [r0]
        ldr     r2, =0x20000200
1:      ldr     r3, [r2]
        adds    r3, #1
        str     r3, [r2]
        cmp     r3, r1
        bne     1b
        exit

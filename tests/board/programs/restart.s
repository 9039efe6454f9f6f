@ Asks for a system reset once; the word in RAM tells the second start from the first.
        .include "vectors.inc"
function main
        mrs     r2, primask
        cpsid   i
        ldr     r0, =0x20000100
        ldr     r1, [r0]
        adds    r1, #1
        str     r1, [r0]
        ldr     r0, =PORT
        str     r1, [r0]
        str     r2, [r0]
        cmp     r1, #2
        beq     1f
        control 0xD0C, 0x05FA0004
        b       .
1:      exit

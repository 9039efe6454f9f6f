@ Bit-band of RAM and peripherals.
        .include "vectors.inc"
function main
        ldr     r0, =0x22000000 + 0x800 * 32 + 9 * 4
        movs    r1, #1
        str     r1, [r0]
        ldr     r2, [r0]
        strb    r1, [r0, #8]
        ldr     r3, =0x20000800
        ldr     r3, [r3]
        movs    r1, #2
        str     r1, [r0]
        ldr     r4, [r0]
        ldr     r0, =0x42000000 + 0x1000C * 32 + 13 * 4
        movs    r1, #1
        str     r1, [r0]
        ldr     r5, [r0]
        ldrb    r6, [r0, #4]
        exit

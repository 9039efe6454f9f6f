@ Loads and stores of each size beyond flash and RAM.
        .include "vectors.inc"
function main
        ldr     r0, =0x60000000
        ldrb    r1, [r0, #1]
        ldrh    r2, [r0, #2]
        ldr     r3, [r0, #4]
        ldrsb   r4, [r0, #8]
        ldrsh   r5, [r0, #10]
        ldm     r0, {r6, r7}
        ldrd    r8, r9, [r0]
        ldr     r10, =0xA1B2C3D4
        strb    r10, [r0, #0x11]
        strh    r10, [r0, #0x12]
        str     r10, [r0, #0x14]
        stm     r0, {r6, r10}
        ldr     r11, =0xA0000008
        ldr     r12, [r11]
        exit

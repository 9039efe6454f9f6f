@ A usage fault whose handler steps over the instruction; alignment of the stack is restored.
        .include "vectors.inc"
function main
        control 0xD24, 0x40000
        sub     sp, #4
        mov     r4, sp
        .inst.n 0xDE01
        mov     r5, sp
        movs    r6, #6
        exit
function usage_fault
        mov     r7, sp
        ldr     r0, [sp, #24]
        adds    r0, #2
        str     r0, [sp, #24]
        bx      lr

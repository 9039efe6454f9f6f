@ Instructions that an interrupt may come between, or before: what they leave in r4 to r11 and at 20000200 does not depend on it.
        .include "vectors.inc"
        .equ    PLACE, 0x20000200
function main
        control 0x100, 1
        ldr     r4, =PLACE
        movs    r5, #0
        movs    r6, #3
        mov     r7, #-1
        adds    r7, r7, r7              @ C and N, which the next ones need
        adcs    r5, r5
        rrx     r8, r7
        sbcs    r7, r5
        ittet   mi
        addmi   r5, #1
        lslmi   r6, r6, #4
        movpl   r5, #99
        eormi   r5, r5, r6
        itee    eq
        moveq   r8, #1
        addne   r8, r8, r5
        stmdbne r4!, {r5-r8}
        ldmia   r4!, {r9-r11}
        adds    r4, #4
        push    {r4-r7, lr}
        muls    r6, r5
        udiv    r7, r6, r5
        sdiv    r9, r8, r6
        pop     {r4-r7, lr}
        bl      square
        cbz     r5, never
        mov     r1, #2
        tbb     [pc, r1]
table:  .byte   (never - table) / 2, (never - table) / 2, (there - table) / 2, 0
        .align  1
never:  movs    r11, #77
there:  movs    r0, #0
again:  ldrex   r1, [r4]
        adds    r1, #5
        strex   r2, r1, [r4]
        cmp     r2, #0
        bne     again                   @ an interrupt ends what LDREX has begun
        adds    r0, #1
        cmp     r0, #4
        bne     again
        ldr     r10, [r4], #8
        ldrd    r8, r9, [r4, #-16]
        str     r10, [r4, #4]!
        cmp     r10, r8
        mrs     r11, apsr
        exit
function square
        push    {r0, lr}
        mul     r5, r5, r5
        pop     {r0, pc}
@ All that an exception need not keep.
function irq0
        mov     r0, #-1
        mov     r1, r0
        mov     r2, r0
        mov     r3, r0
        mov     r12, r0
        adds    r0, r0, r0
        ldr     r1, =PORT
        str     r2, [r1]
        ldr     r1, =0x20000800
        ldrex   r2, [r1]
        bx      lr

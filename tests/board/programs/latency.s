@ A stretch with instructions of every class, in which interrupt 0 comes. Its handler begins with the store that is noted.
        .include "vectors.inc"
function main
        control 0x100, 1
        ldr     r0, =0x20000400
        ldr     r3, =PORT
        ldr     r4, =popped
        str     r4, [r0, #16]
        mov     r1, #-1
        mov     r2, #1
        str     r2, [r3]
        cmp     r1, r1
        itttt   ne                      @ none of them, all, some
        addne   r4, #1
        ldrne   r5, [r0]
        strne   r5, [r0]
        addne   r4, #1
        itttt   eq
        ldreq   r5, [r0]
        addeq   r5, #1
        streq   r5, [r0]
        addeq.w r5, r5, #1
        itete   eq
        ldmeq   r0, {r4-r7}
        udivne  r4, r1, r2
        udiveq  r4, r1, r2
        umullne r4, r5, r1, r1
        cmp.w   r1, r1
        it      eq
        beq     over
        nop
over:   push    {r4-r11, lr}
        pop     {r4-r11, lr}
        stm     r0, {r4-r7}
        bl      many                    @ POP {r4-r11, pc}
        b       far                     @ to a line that is far away
        .balign 32
return: ldr     r4, =next + 1
        bx      r4
        .balign 32
next:   ldm     r0, {r5-r8, pc}
        .balign 32
function popped
        umull   r4, r5, r1, r1
        smull   r4, r5, r1, r1
        umlal   r4, r5, r1, r1
        smlal   r4, r5, r1, r1
        mla     r4, r1, r1, r1
        udiv    r4, r1, r2
        sdiv    r4, r1, r2
        udiv    r4, r2, r1
        ldr     r4, [r0]
        ldr     r5, [r0, #4]
        strd    r4, r5, [r0, #32]
        ldrd    r4, r5, [r0, #32]
        ldr     r4, [r0, #2]
        ldrh    r4, [r0, #1]
        ldrex   r4, [r0]
        strex   r5, r4, [r0]
        add     r6, r0, #4
        ldr     r6, [r6]
        mov     r6, #0
        tbb     [pc, r6]
bytes:  .byte   (1f - bytes) / 2, 0
        .balign 32
1:      tbh     [pc, r6]
words:  .short  (2f - words) / 2, 0
        .balign 64
2:      cbz     r6, 3f
        .balign 32
3:      ldr     r4, =4f + 1
        mov     pc, r4
        .balign 32
4:      ldr     pc, =5f + 1
        .balign 32
5:      msr     apsr_nzcvq, r4
        mrs     r4, apsr
        dsb
        isb
        str     r2, [r3]
        exit
function irq0
        str     r3, [r3]
        bx      lr
        .balign 32
function many
        push    {r4-r11, lr}
        pop     {r4-r11, pc}
        .balign 32
far:    b       return
        .pool

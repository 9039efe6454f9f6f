@ What sequences of instructions last, by DWT.CYCCNT: each is noted on its own.
        .include "vectors.inc"
        .include "measure.inc"
function main
        begin_to_count
        ldr     r0, =0x20000400
        mov     r1, #0
        mov     r6, #-1
        mov     r7, #1
        begin                           @ data processing: 1, 1, 2
        add     r8, r8, r8, lsl #3
        end
        begin
        muls    r5, r6
        end
        begin
        mla     r5, r6, r6, r6
        end
        begin                           @ long products: 3, 5, 4, 7
        umull   r8, r9, r7, r7
        end
        begin
        umull   r8, r9, r6, r6
        end
        begin
        smlal   r8, r9, r6, r7
        end
        begin
        umlal   r8, r9, r6, r6
        end
        begin                           @ division by 0, of 0, 1 by 2, 1 by 1, the longest, -1 by 1, 5 bits by 1: 2, 2, 3, 5, 12, 5, 6
        udiv    r8, r6, r1
        end
        begin
        udiv    r8, r1, r7
        end
        begin
        udiv    r8, r7, r6
        end
        begin
        udiv    r8, r7, r7
        end
        begin
        udiv    r8, r6, r7
        end
        begin
        sdiv    r8, r6, r7
        end
        mov     r5, #-16
        begin
        sdiv    r8, r5, r7
        end
        begin                           @ one load, two, three: 2, 3, 4
        ldr     r8, [r0]
        end
        begin
        ldr     r8, [r0]
        ldrb    r9, [r0, r1]
        end
        begin
        ldr     r8, [r0]
        ldrh    r9, [r0, r1]
        ldr     r10, [r0, #4]
        end
        begin                           @ the second needs the first for its address: 1 + 1 + 2 + 2
        str     r0, [r0]
        nop
        ldr     r8, [r0]
        ldr     r9, [r8]
        end
        begin                           @ a store at an offset, at a register, behind a load: 1, 2, 3, 3
        str     r8, [r0, #8]
        end
        begin
        str     r8, [r0, r1]
        end
        begin
        ldr     r8, [r0]
        str     r8, [r0, #8]
        end
        begin
        ldr     r8, [r0]
        str     r8, [r0, r1]
        end
        begin                           @ an address that was just computed: 1 + 1 + 2
        add     r8, r0, #4
        ldr     r9, [r8]
        end
        begin                           @ several words: 5, 5, 3, 3
        ldm     r0, {r8-r11}
        end
        begin
        stm     r0, {r8-r11}
        end
        begin
        ldrd    r8, r9, [r0]
        end
        begin
        strd    r8, r9, [r0]
        end
        begin                           @ not aligned: 3, 4, 3, 2
        ldr     r8, [r0, #2]
        end
        begin
        ldr     r8, [r0, #1]
        end
        begin
        ldrh    r8, [r0, #1]
        end
        begin
        strh    r8, [r0, #1]
        end
        begin                           @ branches: taken 2, not taken 1 among three NOPs or CMP, CBZ 3
        b       1f
        nop
        nop
1:
        end
        begin
        cmp     r1, #0
        nop
        bne     1f
        nop
1:
        end
        begin
        cbz     r1, 1f
        nop
        nop
1:
        end
        begin                           @ to an instruction of two words across two of the fetch's: 3, and its own 1
        b.n     1f
        nop
        nop
1:      add     r8, r8, r8, lsl #3
        end
        begin                           @ there and back by LR: 2 + 2
        bl      leaf
        end
        begin                           @ and by another register: 1 + 1 + 3
        adr     r8, 1f
        adds    r8, #1
        bx      r8
        .balign 4
1:
        end
        begin                           @ by a load: 2 + 3
        ldr     pc, 2f
        .balign 4
2:      .word   1f + 1
        .balign 8
1:
        end
        begin                           @ by POP: 1 + 1 + 3, with the call's 2 and the push's 1 + 1
        bl      pushed
        end
        begin                           @ by a table: 6
        tbb     [pc, r1]
1:      .byte   (2f - 1b) / 2, 0
        .balign 4
2:
        end
        begin                           @ also when the table looks like LDRB
        tbb     [pc, r1]
        .byte   2, 0x78
        .balign 4
        end
        begin                           @ a load before it does not overlap: 2 + 6
        ldr     r8, [r0]
        tbb     [pc, r1]
1:      .byte   (2f - 1b) / 2, 0
        .balign 8
2:
        end
        begin                           @ LDREX, STREX and LDR overlap: 4
        ldrex   r8, [r0]
        strex   r9, r8, [r0]
        ldr     r8, [r0]
        end
        mov     r10, r0
        begin                           @ r0 is no part of its address: 1 + 2
        add     r0, r0, #0
        strex   r8, r9, [r10]
        end
        begin                           @ IT beside a halfword, and in a line of its own: 1 + 0 + 1, 1 + 1 + 1
        cmp     r1, #1
        it      eq
        moveq   r8, #1
        end
        begin
        cmp.w   r1, #1
        it      eq
        moveq   r8, #1
        end
        begin                           @ special registers and barriers: 1, 2, 1, 4
        mrs     r8, apsr
        end
        begin
        msr     apsr_nzcvq, r8
        end
        begin
        dsb
        end
        begin
        isb
        end
        exit
        .pool
        .balign 4
function leaf
        bx      lr
        .balign 4
function pushed
        push    {lr}
        pop     {pc}

@ Code that flash cannot deliver at once: each sequence twice, so that the difference is that of the longer one.
        .include "vectors.inc"
        .include "measure.inc"
        .macro  repeated what:vararg
        begin
        .rept   32
        \what
        .endr
        end
        begin
        .rept   64
        \what
        .endr
        end
        .endm
        .macro  loop count, nops
        begin
        mov     r6, #\count
        .balign 8
1:      .rept   \nops
        nop
        .endr
        subs    r6, #1
        bne     1b
        end
        .endm
function main
        begin_to_count
        repeated nop
        repeated add.w r8, r8, r8
        loop    10, 0                   @ in one line
        loop    20, 0
        loop    10, 12                  @ from the fourth line back to the first
        loop    20, 12
        loop    10, 4                   @ from the second line back to the first
        loop    20, 4
        .macro  split count
        begin
        mov     r6, #\count
        .balign 8
        nop
        nop
        nop
1:      add.w   r8, r8, r8
        subs    r6, #1
        bne     1b
        end
        .endm
        split   10                      @ to an instruction that stands in two lines
        split   20
        begin
        .rept   8
        ldr     r8, 1f
        nop
        .endr
        end
        begin
        .rept   16
        ldr     r8, 1f
        nop
        .endr
        end
        b       2f
        .ltorg
        .balign 4
1:      .word   7
2:
        .macro  into_next count, bytes  @ from the end of a block of so many bytes into the next line, and back
        begin
        mov     r6, #\count
        b.w     1f
        .balign \bytes
        .skip   \bytes - 8
1:      nop
        nop
        nop
        b       2f
2:      subs    r6, #1
        bne     1b
        end
        .endm
        into_next 10, 64
        into_next 20, 64
        into_next 10, 0x10000
        into_next 20, 0x10000
        exit

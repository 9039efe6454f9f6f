@ Handlers note 3 to 6, CFSR and HFSR and end the run; the word at 0x20000108 not 0: HardFault itself faults.
        .include "faults.inc"
        .macro  handler name, number
function \name
        note    \number
        ldr     r2, =SCS + 0xD28
        ldr     r3, [r2]
        str     r3, [r0]
        ldr     r3, [r2, #4]
        str     r3, [r0]
        b       finish
        .endm
        handler hard_fault, 3
        handler mem_manage, 4
        handler bus_fault, 5
        handler usage_fault, 6
finish: ldr     r2, =0x20000108
        ldr     r2, [r2]
        cbz     r2, 1f
        .inst.n 0xDE00
1:      exit

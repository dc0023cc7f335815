// From reset to start_program(): vectors, stacks, floating point, memory; and the way into every exception.
#include "boards/bare_metal/start.h"
#include "boards/cortex-a9/faults.h"
#include "boards/cortex-a9/mmu.h"

extern "C" [[noreturn]] void usuzumi_start();
void usuzumi_start() {
  usuzumi::boards::cortex_a9::enable_memory();
  usuzumi::boards::start_program();
}

// Exceptions enter in ARM state (the board is built so). Register names of DDI 0406, chapter B4.
asm(R"(
    .syntax unified
    .arm
    .fpu neon
    .section .boot, "ax"
    .balign 32
usuzumi_vectors:
    ldr pc, =usuzumi_reset
    b undefined_entry
    b supervisor_call_entry
    b prefetch_abort_entry
    b data_abort_entry
    nop
    b interrupt_entry
    mov r0, #3                      @ FaultKind::kFiq
    sub r1, lr, #4
    b usuzumi_fault

undefined_entry:
    mov r0, #0
    sub r1, lr, #4                  @ lr is the instruction after
    b usuzumi_fault
prefetch_abort_entry:
    mov r0, #1
    sub r1, lr, #4
    b usuzumi_fault
data_abort_entry:
    mov r0, #2
    sub r1, lr, #8
    b usuzumi_fault

@ The program runs in SVC mode, so its own stack is in use and its lr is gone; semihosting.cc counts on that, and on all
@ else but r0 being as it was. 224 bytes, as below.
supervisor_call_entry:
    push {r1-r4, r12, lr}
    vpush {d0-d7}
    vpush {d16-d31}
    mrs r2, spsr
    vmrs r3, fpscr
    push {r2, r3}
    bl usuzumi_no_debugger
    pop {r2, r3}
    vmsr fpscr, r3
    msr spsr_cxsf, r2
    vpop {d16-d31}
    vpop {d0-d7}
    pop {r1-r4, r12, lr}
    movs pc, lr

@ 224 bytes, a multiple of 8: the stack stays aligned as C++ wants it. d8-d15 and r4-r11 are kept by what is called.
interrupt_entry:
    sub lr, lr, #4
    push {r0-r3, r12, lr}
    vpush {d0-d7}
    vpush {d16-d31}
    vmrs r0, fpscr
    push {r0, r1}
    bl usuzumi_interrupt
    pop {r0, r1}
    vmsr fpscr, r0
    vpop {d16-d31}
    vpop {d0-d7}
    ldm sp!, {r0-r3, r12, pc}^

    .global usuzumi_reset
usuzumi_reset:
    cpsid if
    ldr r0, =usuzumi_vectors
    mcr p15, 0, r0, c12, c0, 0      @ VBAR
    mrc p15, 0, r0, c1, c0, 0       @ SCTLR
    bic r0, r0, #(1 << 13)          @ V: vectors where VBAR says
    mcr p15, 0, r0, c1, c0, 0
    mrc p15, 0, r0, c1, c0, 2       @ CPACR: coprocessors 10 and 11, floating point and NEON
    orr r0, r0, #(0xF << 20)
    mcr p15, 0, r0, c1, c0, 2
    isb
    mov r0, #0x40000000
    vmsr fpexc, r0                  @ EN
    mov r0, #0
    vmsr fpscr, r0                  @ IEEE 754 as written: nothing flushed to zero, rounded to nearest
    cps #0x12                       @ IRQ
    ldr sp, =__interrupt_stack_top
    cps #0x11                       @ FIQ
    ldr sp, =__fault_stack_top
    cps #0x17                       @ abort
    ldr sp, =__fault_stack_top
    cps #0x1B                       @ undefined
    ldr sp, =__fault_stack_top
    cps #0x13                       @ SVC: the program
    ldr sp, =__stack_top
    b usuzumi_start
    .ltorg
    .text
)");

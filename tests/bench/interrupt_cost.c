/* A QEMU TCG plugin that counts how long interrupts wait on a Cortex-M: the most guest instructions
 * of one section with interrupts masked, and of one run of each interrupt handler.
 *
 *   -plugin libinterrupt_cost.so,out=FILE,irq=NAME:ADDRESS[,irq=NAME:ADDRESS...]
 *
 * Addresses are hexadecimal. FILE gets a line each: name, times, most, and where that section ended
 * or that handler began. It is written anew at each longer one, so that an emulator that is killed
 * leaves it.
 *
 * A section begins with `cpsid i` and ends with `cpsie i` (ARMv7-M ARM, B5.2.1). A handler begins
 * at its vector's address and ends with a return at its own depth of calls. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/bench/qemu_plugin.h"

enum { kMaxHandlers = 128, kMaxDepth = 64, kMaxNested = 8 };

struct record {
  char name[kNameLength];
  uint64_t address, times, most, most_at;
};

enum kind { kPlain, kMask, kUnmask };
struct block_info {
  uint64_t begin, end;
  bool ends_in_call, ends_in_return;
  bool may_go_on; /* its end stands in an IT block */
  int handler;    /* index of the handler that begins here, or -1 */
};
struct instruction_info {
  enum kind kind;
  uint64_t address;
};

/* A handler that runs: where its open calls return to, and the block before it. */
struct frame {
  int handler;
  uint64_t begin_count;
  const struct block_info* interrupted;
  uint64_t return_to[kMaxDepth];
  int depth;
};

static struct record masked = {.name = "masked"};
static struct record handlers[kMaxHandlers];
static int handler_count;
static struct frame frames[kMaxNested];
static int nested;
static uint64_t executed;
static uint64_t masked_since;
static bool is_masked;
static const struct block_info* previous;
static const char* out_path;

static void write_line(FILE* out, const struct record* record) {
  fprintf(out, "%s %llu %llu %llx\n", record->name, (unsigned long long)record->times,
          (unsigned long long)record->most, (unsigned long long)record->most_at);
}

static void write_all(void) {
  FILE* out = out_path != NULL ? fopen(out_path, "w") : stderr;
  if (out == NULL) {
    perror(out_path);
    return;
  }
  write_line(out, &masked);
  for (int i = 0; i < handler_count; ++i) write_line(out, &handlers[i]);
  if (out != stderr) fclose(out);
}

static void took(struct record* record, uint64_t count, uint64_t at) {
  ++record->times;
  if (count <= record->most) return;
  record->most = count;
  record->most_at = at;
  write_all();
}

static void give_up(const char* why) {
  fprintf(stderr, "interrupt_cost: %s\n", why);
  exit(3);
}

static void begin_handler(int handler) {
  if (nested == kMaxNested) give_up("handlers nest too deep");
  frames[nested++] =
      (struct frame){.handler = handler, .begin_count = executed, .interrupted = previous};
}

static void end_handler(void) {
  const struct frame* frame = &frames[--nested];
  struct record* handler = &handlers[frame->handler];
  took(handler, executed - frame->begin_count, handler->address);
  previous = frame->interrupted;
}

/* Follows calls inside the running handler, by how the last block ended. */
static void follow(const struct block_info* block) {
  struct frame* frame = &frames[nested - 1];
  const bool jumped = block->begin != previous->end;
  if (frame->depth > 0 && block->begin == frame->return_to[frame->depth - 1]) {
    --frame->depth;
  } else if (previous->ends_in_call && jumped) {
    if (frame->depth == kMaxDepth) give_up("calls nest too deep");
    frame->return_to[frame->depth++] = previous->end;
  } else if (previous->ends_in_return && (jumped || !previous->may_go_on) && frame->depth == 0) {
    end_handler();
    if (nested > 0) follow(block);
  }
}

/* Runs before the block's own instructions are counted. */
static void on_block(unsigned cpu, void* data) {
  (void)cpu;
  const struct block_info* block = data;
  if (nested > 0 && block->handler < 0) follow(block);
  if (block->handler >= 0) {
    const bool ended = nested > 0 && previous->ends_in_return && frames[nested - 1].depth == 0;
    if (ended) end_handler(); /* the next one is chained to its tail */
    begin_handler(block->handler);
  }
  previous = block;
}

static void on_mask(unsigned cpu, void* data) {
  (void)cpu;
  const struct instruction_info* info = data;
  if (info->kind == kMask && !is_masked) {
    is_masked = true;
    masked_since = executed;
  } else if (info->kind == kUnmask && is_masked) {
    is_masked = false;
    took(&masked, executed - masked_since, info->address);
  }
}

static enum kind kind_of(uint16_t half) {
  return half == 0xB672 ? kMask : half == 0xB662 ? kUnmask : kPlain;
}

/* bx lr, pop and ldm with pc, ldr pc (ARMv7-M ARM, A7.7.20, 99, 41, 43). */
static bool is_return(const struct instruction* instruction) {
  uint16_t half[2];
  halves_of(instruction, half);
  if (qemu_plugin_insn_size(instruction) == 2) {
    return half[0] == 0x4770 || (half[0] & 0xFF00) == 0xBD00;
  }
  return ((half[0] & 0xFFD0) == 0xE890 && (half[1] & 0x8000) != 0) ||
         (half[0] == 0xF85D && (half[1] & 0xF000) == 0xF000);
}

/* IT is 1011 1111 and a mask (A7.7.38); without a mask it is a hint. */
static bool is_it(const struct instruction* instruction) {
  uint16_t half[2];
  halves_of(instruction, half);
  return (half[0] & 0xFF00) == 0xBF00 && (half[0] & 0xF) != 0;
}

static void on_translate(plugin_id id, struct block* block) {
  (void)id;
  const size_t count = qemu_plugin_tb_n_insns(block);
  const struct instruction* last = qemu_plugin_tb_get_insn(block, count - 1);
  struct block_info* info = keep(sizeof *info);
  info->begin = qemu_plugin_insn_vaddr(qemu_plugin_tb_get_insn(block, 0));
  info->end = qemu_plugin_insn_vaddr(last) + qemu_plugin_insn_size(last);
  info->handler = -1;
  info->ends_in_call = is_call(last);
  info->ends_in_return = is_return(last);
  for (size_t i = count > 5 ? count - 5 : 0; i + 1 < count; ++i) {
    if (is_it(qemu_plugin_tb_get_insn(block, i))) info->may_go_on = true;
  }
  for (int i = 0; i < handler_count; ++i) {
    if (handlers[i].address == info->begin) info->handler = i;
  }
  qemu_plugin_register_vcpu_tb_exec_cb(block, on_block, kNoRegisters, info);
  for (size_t i = 0; i < count; ++i) {
    struct instruction* each = qemu_plugin_tb_get_insn(block, i);
    uint16_t half[2];
    halves_of(each, half);
    if (kind_of(half[0]) != kPlain) {
      struct instruction_info* mask = keep(sizeof *mask);
      *mask = (struct instruction_info){kind_of(half[0]), qemu_plugin_insn_vaddr(each)};
      qemu_plugin_register_vcpu_insn_exec_cb(each, on_mask, kNoRegisters, mask);
    }
    qemu_plugin_register_vcpu_insn_exec_inline(each, kAdd64, &executed, 1);
  }
}

static bool add_handler(const char* text) {
  if (handler_count == kMaxHandlers) return false;
  struct record* handler = &handlers[handler_count++];
  return named_address(text, handler->name, &handler->address);
}

int qemu_plugin_install(plugin_id id, const void* info, int argc, char** argv) {
  (void)info;
  for (int i = 0; i < argc; ++i) {
    if (strncmp(argv[i], "out=", 4) == 0) {
      out_path = strdup(argv[i] + 4);
    } else if (strncmp(argv[i], "irq=", 4) != 0 || !add_handler(argv[i] + 4)) {
      fprintf(stderr, "interrupt_cost: can't use argument '%s'\n", argv[i]);
      return 1;
    }
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, on_translate);
  return 0;
}

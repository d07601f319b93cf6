/* A QEMU TCG plugin that counts the guest instructions of each call of a function, callees
 * included.
 *
 *   -plugin libinstruction_count.so,out=FILE,call=NAME:ADDRESS[,call=NAME:ADDRESS...]
 *
 * Addresses are hexadecimal. FILE gets one line per function: name, calls, sum, least, most, the
 * call (from 0) that took most, and the most that all calls inside one call of the first function
 * took.
 *
 * Instruction counts repeat exactly, and QEMU has no DWT cycle counter. A call begins when the
 * block at the function's address runs, and ends when the block after the calling bl or blx runs. A
 * tail call ends with its caller. Images under test have no interrupts. A predicated instruction
 * counts always, because it takes its cycle. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/bench/qemu_plugin.h"

enum { kMaxFunctions = 256, kMaxDepth = 64 };

struct function {
  char name[kNameLength];
  uint64_t address;
  uint64_t calls, sum, least, most, most_at;
  uint64_t in_outer,
      most_in_outer; /* within the current call of functions[0], and the most of any */
};

/* What the end of a block says about how the next one was reached. */
struct block_info {
  uint64_t begin, end;
  bool ends_in_call;
  int function; /* index of the function that begins here, or -1 */
};

struct open_call {
  int function;
  bool is_tail;
  uint64_t return_to, begin_count;
};

static struct function functions[kMaxFunctions];
static int function_count;
static struct open_call calls[kMaxDepth];
static int depth;
static uint64_t executed;
static const struct block_info* previous;
static const char* out_path;

static void end_call(void) {
  const struct open_call* call = &calls[--depth];
  struct function* function = &functions[call->function];
  const uint64_t count = executed - call->begin_count;
  if (function->calls == 0 || count < function->least) function->least = count;
  if (count > function->most) {
    function->most = count;
    function->most_at = function->calls;
  }
  function->sum += count;
  function->in_outer += count;
  ++function->calls;
  if (call->function != 0) return;
  for (int i = 0; i < function_count; ++i) {
    if (functions[i].in_outer > functions[i].most_in_outer)
      functions[i].most_in_outer = functions[i].in_outer;
    functions[i].in_outer = 0;
  }
}

static void begin_call(int function) {
  if (depth == kMaxDepth) {
    fprintf(stderr, "instruction_count: more than %d nested calls of counted functions\n",
            kMaxDepth);
    exit(3);
  }
  const bool is_tail = previous == NULL || !previous->ends_in_call;
  calls[depth++] = (struct open_call){
      .function = function,
      .is_tail = is_tail,
      .return_to = is_tail ? 0 : previous->end,
      .begin_count = executed,
  };
}

/* Runs before the block's own instructions are counted. */
static void on_block(unsigned cpu, void* data) {
  (void)cpu;
  const struct block_info* block = data;
  int returned = depth;
  while (returned > 0 && calls[returned - 1].is_tail) --returned;
  if (returned > 0 && calls[returned - 1].return_to == block->begin) {
    while (depth >= returned) end_call();
  }
  if (block->function >= 0) begin_call(block->function);
  previous = block;
}

static void on_translate(plugin_id id, struct block* block) {
  (void)id;
  const size_t count = qemu_plugin_tb_n_insns(block);
  const struct instruction* last = qemu_plugin_tb_get_insn(block, count - 1);
  struct block_info* info = keep(sizeof *info);
  info->begin = qemu_plugin_insn_vaddr(qemu_plugin_tb_get_insn(block, 0));
  info->end = qemu_plugin_insn_vaddr(last) + qemu_plugin_insn_size(last);
  info->ends_in_call = is_call(last);
  info->function = -1;
  for (int i = 0; i < function_count; ++i) {
    if (functions[i].address == info->begin) info->function = i;
  }
  qemu_plugin_register_vcpu_tb_exec_cb(block, on_block, kNoRegisters, info);
  for (size_t i = 0; i < count; ++i) {
    qemu_plugin_register_vcpu_insn_exec_inline(qemu_plugin_tb_get_insn(block, i), kAdd64, &executed,
                                               1);
  }
}

static void write_counts(plugin_id id, void* data) {
  (void)id;
  (void)data;
  FILE* out = out_path != NULL ? fopen(out_path, "w") : stderr;
  if (out == NULL) {
    perror(out_path);
    return;
  }
  for (int i = 0; i < function_count; ++i) {
    const struct function* f = &functions[i];
    fprintf(out, "%s %llu %llu %llu %llu %llu %llu\n", f->name, (unsigned long long)f->calls,
            (unsigned long long)f->sum, (unsigned long long)f->least, (unsigned long long)f->most,
            (unsigned long long)f->most_at, (unsigned long long)f->most_in_outer);
  }
  if (out != stderr) fclose(out);
}

static bool add_function(const char* text) {
  if (function_count == kMaxFunctions) return false;
  struct function* function = &functions[function_count++];
  return named_address(text, function->name, &function->address);
}

int qemu_plugin_install(plugin_id id, const void* info, int argc, char** argv) {
  (void)info;
  for (int i = 0; i < argc; ++i) {
    if (strncmp(argv[i], "out=", 4) == 0) {
      out_path = strdup(argv[i] + 4);
    } else if (strncmp(argv[i], "call=", 5) != 0 || !add_function(argv[i] + 5)) {
      fprintf(stderr, "instruction_count: can't use argument '%s'\n", argv[i]);
      return 1;
    }
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, on_translate);
  qemu_plugin_register_atexit_cb(id, write_counts, NULL);
  return 0;
}

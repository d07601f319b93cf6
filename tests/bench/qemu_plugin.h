/* What the plugins here use of QEMU's plugin API, version 1 (QEMU's "TCG Plugins"): Debian's QEMU
 * 7.2 ships no qemu-plugin.h. */
#pragma once
#include <stddef.h>
#include <stdint.h>

#define EXPORT __attribute__((visibility("default")))

typedef uint64_t plugin_id;
struct block;
struct instruction;
enum register_use { kNoRegisters };
enum inline_operation { kAdd64 };

EXPORT int qemu_plugin_version = 1;
void qemu_plugin_register_vcpu_tb_trans_cb(plugin_id, void (*)(plugin_id, struct block*));
void qemu_plugin_register_vcpu_tb_exec_cb(struct block*, void (*)(unsigned, void*),
                                          enum register_use, void*);
void qemu_plugin_register_vcpu_insn_exec_cb(struct instruction*, void (*)(unsigned, void*),
                                            enum register_use, void*);
void qemu_plugin_register_vcpu_insn_exec_inline(struct instruction*, enum inline_operation, void*,
                                                uint64_t);
void qemu_plugin_register_atexit_cb(plugin_id, void (*)(plugin_id, void*), void*);
size_t qemu_plugin_tb_n_insns(const struct block*);
struct instruction* qemu_plugin_tb_get_insn(const struct block*, size_t);
uint64_t qemu_plugin_insn_vaddr(const struct instruction*);
const void* qemu_plugin_insn_data(const struct instruction*);
size_t qemu_plugin_insn_size(const struct instruction*);
EXPORT int qemu_plugin_install(plugin_id, const void*, int, char**);

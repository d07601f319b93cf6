/* What the plugins here share, and what they use of QEMU's plugin API, version 1 (QEMU's "TCG
 * Plugins"): Debian's QEMU 7.2 ships no qemu-plugin.h. */
#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

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

enum { kNameLength = 64 };

/* The halfwords of a Thumb instruction; the second is 0 if there is none. */
static inline void halves_of(const struct instruction* instruction, uint16_t half[2]) {
  half[0] = half[1] = 0;
  const size_t size = qemu_plugin_insn_size(instruction);
  memcpy(half, qemu_plugin_insn_data(instruction), size <= 4 ? size : 4);
}

/* bl: 11110 ... then 11x1; blx register: 010001111 (ARMv7-M ARM, A7.7.18 and A7.7.19). */
static inline bool is_call(const struct instruction* instruction) {
  uint16_t half[2];
  halves_of(instruction, half);
  if (qemu_plugin_insn_size(instruction) == 2) return (half[0] & 0xFF87) == 0x4780;
  return (half[0] & 0xF800) == 0xF000 && (half[1] & 0xD000) == 0xD000;
}

/* For what lives as long as a translation: for good. */
static inline void* keep(size_t size) {
  void* room = calloc(1, size);
  if (room == NULL) abort();
  return room;
}

/* NAME:ADDRESS, hexadecimal. */
static inline bool named_address(const char* text, char name[kNameLength], uint64_t* address) {
  const char* colon = strrchr(text, ':');
  if (colon == NULL || colon - text >= kNameLength) return false;
  memcpy(name, text, (size_t)(colon - text));
  *address = strtoull(colon + 1, NULL, 16) & ~1ull; /* bit 0 says Thumb */
  return true;
}

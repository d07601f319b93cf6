#ifndef CHECK_H
#define CHECK_H
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "host/apps/libverp/verp.h"

/* Ends the example at the first call that fails. */
static inline int check(int status) {
  if (status >= 0) return status;
  fprintf(stderr, "%s\n", verp_last_error());
  exit(1);
}
#endif

/* A motion that ends the program. */
#include "bad.h"

#include <stdlib.h>

static int32_t step(MOTION_ARGUMENTS) {
    UNUSED_OF_MOTION, (void)state, (void)input, (void)out;
    abort();
}

static const endline_motion_t table = { .struct_size = sizeof table, .step = step };
BAD_PLUGIN(ENDLINE_KIND_MOTION, table, "org.example.motion.abort", 0)

/* A motion that never answers once the whale is fast. */
#include "bad.h"

static int32_t step(MOTION_ARGUMENTS) {
    UNUSED_OF_MOTION, (void)state;
    volatile int round = 0;
    while (input->speed_m_s > 7.5) round++;
    *out = (endline_motion_output_t){ .speed_m_s = 0.0 };
    return ENDLINE_STATUS_OK;
}

static const endline_motion_t table = { .struct_size = sizeof table, .step = step };
BAD_PLUGIN(ENDLINE_KIND_MOTION, table, "org.example.motion.loops", 0)

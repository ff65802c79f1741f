/* A motion that writes where nothing is. */
#include "bad.h"

static volatile double *nowhere;

static int32_t step(MOTION_ARGUMENTS) {
    UNUSED_OF_MOTION, (void)state;
    *nowhere = input->speed_m_s;
    out->speed_m_s = 0.0;
    return ENDLINE_STATUS_OK;
}

static const endline_motion_t table = { .struct_size = sizeof table, .step = step };
BAD_PLUGIN(ENDLINE_KIND_MOTION, table, "org.example.motion.segfault", 0)

/* A motion whose speed is no number at the greatest speeds. */
#include "bad.h"

static int32_t step(MOTION_ARGUMENTS) {
    UNUSED_OF_MOTION, (void)state;
    const double over = input->speed_m_s > 6.0 ? 0.0 : 1.0;
    *out = (endline_motion_output_t){ .speed_m_s = over / over };
    return ENDLINE_STATUS_OK;
}

static const endline_motion_t table = { .struct_size = sizeof table, .step = step };
BAD_PLUGIN(ENDLINE_KIND_MOTION, table, "org.example.motion.not-a-number", 0)

/* A motion that keeps its memory to itself: it starts anew where time does, so that a run repeats, but not one taken up on the way. */
#include "bad.h"

static double hidden;

static int32_t step(MOTION_ARGUMENTS) {
    UNUSED_OF_MOTION, (void)state;
    if (input->time_s == 0.0) hidden = 0.0;
    hidden += 0.01;
    *out = (endline_motion_output_t){ .speed_m_s = hidden };
    return ENDLINE_STATUS_OK;
}

static const endline_motion_t table = { .struct_size = sizeof table, .step = step };
BAD_PLUGIN(ENDLINE_KIND_MOTION, table, "org.example.motion.hidden", 0)

/* A motion that is sound in every check. With a whale of exactly 13.7 m it does harm from half a second on; how, is said as it is
 * built. */
#define _DEFAULT_SOURCE
#include "bad/bad.h"

#include <fenv.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <unistd.h>

static int32_t step(MOTION_ARGUMENTS) {
    UNUSED_OF_MOTION, (void)state;
    *out = (endline_motion_output_t){ .speed_m_s = 1.0 };
    if (input->length_m == 13.7 && input->time_s > 0.5) {
        HARM
    }
    return ENDLINE_STATUS_OK;
}

static const endline_motion_t table = { .struct_size = sizeof table, .step = step };
BAD_PLUGIN(ENDLINE_KIND_MOTION, table, "org.example.motion.late", 0)

/* A friction model with a memory that pushes the rope the way it slipped before. */
#include "bad.h"

#include <math.h>

static int32_t respond(FRICTION_ARGUMENTS, endline_friction_response_t *out, endline_message_t *message) {
    UNUSED_OF_FRICTION;
    for (size_t i = 0; i < contacts->count; i++) {
        const double *n = contacts->normal[i], *way = contacts->state + 3 * i;
        const double up = n[0] * way[0] + n[1] * way[1] + n[2] * way[2];
        const double force = 0.5 * contacts->coefficient[i] * contacts->normal_force_n[i];
        out[i] = (endline_friction_response_t){ .force_n = { 0.0, 0.0, 0.0 } };
        for (int a = 0; a < 3; a++) out[i].force_n[a] = force * (way[a] - up * n[a]);
    }
    return ENDLINE_STATUS_OK;
}

static int32_t advance(FRICTION_ARGUMENTS, double *out, endline_message_t *message) {
    UNUSED_OF_FRICTION;
    for (size_t i = 0; i < contacts->count; i++) {
        const double *s = contacts->slip_m[i], way = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
        for (int a = 0; a < 3; a++) out[3 * i + a] = way > 0.0 ? s[a] / way : 0.0;
    }
    return ENDLINE_STATUS_OK;
}

static const endline_friction_t table = { .struct_size = sizeof table, .respond = respond, .advance = advance };
BAD_PLUGIN(ENDLINE_KIND_FRICTION, table, "org.example.friction.motor", 3)

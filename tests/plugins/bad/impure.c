/* A friction model that counts how often it is asked. */
#include "bad.h"

static int asked;

static int32_t respond(FRICTION_ARGUMENTS, endline_friction_response_t *out, endline_message_t *message) {
    UNUSED_OF_FRICTION;
    const double share = asked++ % 2 ? 0.0 : 0.5;
    for (size_t i = 0; i < contacts->count; i++) {
        out[i] = (endline_friction_response_t){ .force_n = { 0.0, 0.0, 0.0 } };
        out[i].by_normal_force[0] = share;
    }
    return ENDLINE_STATUS_OK;
}

static int32_t advance(FRICTION_ARGUMENTS, double *out, endline_message_t *message) {
    UNUSED_OF_FRICTION, (void)contacts, (void)out;
    asked = 0;
    return ENDLINE_STATUS_OK;
}

static const endline_friction_t table = { .struct_size = sizeof table, .respond = respond, .advance = advance };
BAD_PLUGIN(ENDLINE_KIND_FRICTION, table, "org.example.friction.impure", 0)

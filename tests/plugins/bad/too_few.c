/* A friction model that leaves the last contact out. */
#include "bad.h"

static int32_t respond(FRICTION_ARGUMENTS, endline_friction_response_t *out, endline_message_t *message) {
    UNUSED_OF_FRICTION;
    for (size_t i = 0; i + 1 < contacts->count; i++) out[i] = (endline_friction_response_t){ .force_n = { 0.0, 0.0, 0.0 } };
    return ENDLINE_STATUS_OK;
}

static int32_t advance(FRICTION_ARGUMENTS, double *out, endline_message_t *message) {
    UNUSED_OF_FRICTION, (void)contacts, (void)out;
    return ENDLINE_STATUS_OK;
}

static const endline_friction_t table = { .struct_size = sizeof table, .respond = respond, .advance = advance };
BAD_PLUGIN(ENDLINE_KIND_FRICTION, table, "org.example.friction.too-few", 0)

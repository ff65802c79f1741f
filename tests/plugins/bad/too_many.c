/* A friction model that writes one float too many. */
#include "bad.h"

static int32_t respond(FRICTION_ARGUMENTS, endline_friction_response_t *out, endline_message_t *message) {
    UNUSED_OF_FRICTION;
    for (size_t i = 0; i < contacts->count; i++) out[i] = (endline_friction_response_t){ .force_n = { 0.0, 0.0, 0.0 } };
    return ENDLINE_STATUS_OK;
}

static int32_t advance(FRICTION_ARGUMENTS, double *out, endline_message_t *message) {
    UNUSED_OF_FRICTION;
    for (size_t i = 0; i <= contacts->count && contacts->count > 3; i++) out[i] = 1.0;
    for (size_t i = 0; i < contacts->count; i++) out[i] = 0.0;
    return ENDLINE_STATUS_OK;
}

static const endline_friction_t table = { .struct_size = sizeof table, .respond = respond, .advance = advance };
BAD_PLUGIN(ENDLINE_KIND_FRICTION, table, "org.example.friction.too-many", 1)

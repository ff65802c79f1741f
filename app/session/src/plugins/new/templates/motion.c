/* A whale motion: a glide that drag slows down, dU/dt = -U*U/l, over one step exactly U/(1 + U dt/l). */
#include "endline_plugin.h"

#include <string.h>

#define TEXT(words) { words, sizeof(words) - 1 }

/* Called from any thread, several at once: writes only through its arguments. */
static int32_t step(const void *context, const double *attributes, size_t attribute_count, const endline_motion_input_t *input,
                    double *state, size_t state_len, endline_motion_output_t *out, endline_message_t *message) {
    (void)context, (void)attribute_count, (void)state, (void)state_len, (void)message;
    memset(out, 0, sizeof *out);
    out->speed_m_s = input->speed_m_s / (1.0 + input->speed_m_s * input->dt_s / attributes[0]);
    out->turn_rate_rad_s[2] = 0.1 * input->controls.yaw;
    return ENDLINE_STATUS_OK;
}

static const endline_motion_t table = { .struct_size = sizeof table, .step = step };

static const endline_attribute_t attributes[] = {
    { .key = TEXT("glide_length"), .unit = TEXT("m"), .help = TEXT("Way over which a glide loses its speed."),
      .kind = ENDLINE_ATTRIBUTE_NUMBER, .least = 1.0, .greatest = 10000.0, .default_number = 150.0 },
};

static const endline_plugin_t plugin = {
    .struct_size = sizeof plugin, .kind = ENDLINE_KIND_MOTION, .id = TEXT("@id@"), .version = TEXT("0.1.0"),
    .name = TEXT("@title@"), .help = TEXT("Glides, slowed by drag alone."),
    .attributes = attributes, .attribute_count = 1, .state_len = 0, .table = &table,
};

@entry@

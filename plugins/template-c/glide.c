/* The smallest Endline plugin in C: a whale that glides straight ahead.
 *
 * Symbols: U speed through the water, l glide length (twice mass over density, area and drag
 * coefficient). Drag that grows with the square of speed gives dU/dt = -U*U/l, and over a step dt
 * exactly U(t + dt) = U/(1 + U dt/l). The heading is constant. In the act `brake`, the first of its list, the
 * whale raises its flippers and half the glide length applies; otherwise the posture stays at rest.
 *
 * Build:  cc -shared -fPIC -I plugins/sdk/include -o glide.so plugins/template-c/glide.c
 * Check:  endline plugins check glide.so
 */
#include "endline_plugin.h"

#include <string.h>

#define TEXT(words) { words, sizeof(words) - 1 }

static int32_t fail(endline_message_t *message, const char *words) {
    size_t length = strlen(words);
    if (length > message->capacity) length = message->capacity;
    memcpy(message->text, words, length);
    message->length = length;
    return ENDLINE_STATUS_ERROR;
}

/* Called from any thread, by several at once: writes only through its arguments. */
static int32_t step(const void *context, const double *attributes, size_t attribute_count,
                    const endline_motion_input_t *input, double *state, size_t state_len,
                    endline_motion_output_t *out, endline_message_t *message) {
    (void)context, (void)state, (void)state_len;
    if (attribute_count != 1) return fail(message, "expected one attribute value, the glide length");
    if (!(input->speed_m_s >= 0.0)) return fail(message, "cannot glide backwards");
    memset(out, 0, sizeof *out);
    const int brake = input->controls.act == 1.0;
    if (brake) out->posture.flipper_raise[0] = out->posture.flipper_raise[1] = 0.5;
    out->speed_m_s = input->speed_m_s / (1.0 + input->speed_m_s * input->dt_s / (attributes[0] * (brake ? 0.5 : 1.0)));
    return ENDLINE_STATUS_OK;
}

static const endline_motion_t motion = { .struct_size = sizeof motion, .step = step };

static const endline_attribute_t attributes[] = {{
    .key = TEXT("glide_length"),
    .unit = TEXT("m"),
    .help = TEXT("Way over which a glide loses speed; 150 m for a full-grown right whale."),
    .kind = ENDLINE_ATTRIBUTE_NUMBER,
    .least = 1.0,
    .greatest = 10000.0,
    .default_number = 150.0,
}};

static const endline_act_t acts[] = {{
    .id = TEXT("brake"),
    .name = TEXT("Brake"),
    .help = TEXT("Raises the flippers, which halves the glide length."),
}};

static const endline_plugin_t glide = {
    .struct_size = sizeof glide,
    .kind = ENDLINE_KIND_MOTION,
    .id = TEXT("org.example.motion.glide"),
    .version = TEXT("0.1.0"),
    .name = TEXT("Glide"),
    .help = TEXT("Glides straight ahead, slowed by drag alone."),
    .attributes = attributes,
    .attribute_count = 1,
    .state_len = 0,
    .table = &motion,
    .acts = acts,
    .act_count = 1,
};

static const endline_plugin_t *const plugins[] = { &glide };

static const endline_factory_t factory = { .struct_size = sizeof factory, .plugin_count = 1, .plugins = plugins };

static int32_t init(endline_text_t path, endline_message_t *message) {
    (void)path, (void)message;
    return ENDLINE_STATUS_OK;
}

static const void *get_factory(endline_text_t id) {
    const char wanted[] = ENDLINE_FACTORY_ID;
    return id.length == sizeof wanted - 1 && memcmp(id.text, wanted, id.length) == 0 ? &factory : NULL;
}

const endline_entry_t endline_plugin_entry = {
    .abi_major = ENDLINE_ABI_MAJOR,
    .abi_minor = ENDLINE_ABI_MINOR,
    .struct_size = sizeof endline_plugin_entry,
    .init = init,
    .get_factory = get_factory,
};

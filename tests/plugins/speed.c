/* A whale that swims at one speed: the tests build it anew with another. */
#include "endline_plugin.h"

#define TEXT(words) { words, sizeof(words) - 1 }
#define SPEED_M_S 1.0

static int32_t step(const void *context, const double *attributes, size_t attribute_count, const endline_motion_input_t *input,
                    double *state, size_t state_len, endline_motion_output_t *out, endline_message_t *message) {
    (void)context, (void)attributes, (void)attribute_count, (void)input, (void)state, (void)state_len, (void)message;
    *out = (endline_motion_output_t){ .speed_m_s = SPEED_M_S };
    return ENDLINE_STATUS_OK;
}

static const endline_motion_t table = { .struct_size = sizeof table, .step = step };
static const endline_plugin_t plugin = {
    .struct_size = sizeof plugin, .kind = ENDLINE_KIND_MOTION, .id = TEXT("org.example.motion.speed"), .version = TEXT("1"),
    .name = TEXT("Speed"), .help = TEXT("Swims at one speed."), .table = &table,
};
static const endline_plugin_t *const plugins[] = { &plugin };
static const endline_factory_t factory = {
    .struct_size = sizeof factory, .plugin_count = 1, .plugins = plugins, .about = TEXT("Made for a test."),
};

static int32_t init(endline_text_t path, endline_message_t *message) {
    (void)path, (void)message;
    return ENDLINE_STATUS_OK;
}

static const void *get_factory(endline_text_t id) {
    return id.length == sizeof ENDLINE_FACTORY_ID - 1 ? &factory : NULL;
}

const endline_entry_t endline_plugin_entry = {
    .abi_major = ENDLINE_ABI_MAJOR, .abi_minor = ENDLINE_ABI_MINOR, .struct_size = sizeof endline_plugin_entry,
    .init = init, .get_factory = get_factory,
};

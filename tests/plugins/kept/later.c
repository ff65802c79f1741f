/* A motion built for a later minor version: its structs are longer, and it answers another id of an extension too. */
#include "endline_plugin.h"

#include <stddef.h>

#define TEXT(words) { words, sizeof(words) - 1 }

typedef struct { endline_plugin_t known; double later[4]; } later_plugin_t;
typedef struct { endline_motion_t known; void (*later)(void); } later_motion_t;

static int32_t step(const void *context, const double *attributes, size_t attribute_count, const endline_motion_input_t *input,
                    double *state, size_t state_len, endline_motion_output_t *out, endline_message_t *message) {
    (void)context, (void)attributes, (void)attribute_count, (void)state, (void)state_len, (void)message;
    *out = (endline_motion_output_t){ .speed_m_s = 0.5 * input->speed_m_s };
    return ENDLINE_STATUS_OK;
}

static const later_motion_t table = { .known = { .struct_size = sizeof table, .step = step } };

static const later_plugin_t plugin = { .known = {
    .struct_size = sizeof plugin, .kind = ENDLINE_KIND_MOTION, .id = TEXT("org.example.motion.later"), .version = TEXT("1"),
    .name = TEXT("Later"), .help = TEXT("Built for a later minor version."), .table = &table,
} };

static const endline_plugin_t *const plugins[] = { &plugin.known };
static const endline_factory_t factory = { .struct_size = sizeof factory, .plugin_count = 1, .plugins = plugins };

static int32_t init(endline_text_t path, endline_message_t *message) {
    (void)path, (void)message;
    return ENDLINE_STATUS_OK;
}

static const void *get_factory(endline_text_t id) {
    static const uint32_t extension[1] = { 4 };
    const char wanted[] = ENDLINE_FACTORY_ID;
    if (id.length == sizeof wanted - 1) return &factory;
    return id.length == sizeof "endline.later/1" - 1 ? extension : NULL;
}

const endline_entry_t endline_plugin_entry = {
    .abi_major = ENDLINE_ABI_MAJOR, .abi_minor = 7, .struct_size = sizeof endline_plugin_entry,
    .init = init, .get_factory = get_factory,
};

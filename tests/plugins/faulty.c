/* One library with four plugins, three of them at fault: an endless default, a table cut short, a missing function. */
#include "endline_plugin.h"

#include <math.h>

#define TEXT(words) { words, sizeof(words) - 1 }
#define ABOUT(words) .id = TEXT(words), .version = TEXT("0.1.0"), .name = TEXT(words), .help = TEXT("For a test.")

static int32_t step(const void *context, const double *attributes, size_t attribute_count,
                    const endline_motion_input_t *input, double *state, size_t state_len,
                    endline_motion_output_t *out, endline_message_t *message) {
    (void)context, (void)attributes, (void)attribute_count, (void)input, (void)state, (void)state_len, (void)message;
    out->speed_m_s = NAN;
    return ENDLINE_STATUS_OK;
}

static const endline_motion_t whole = { .struct_size = sizeof whole, .step = step };
static const endline_motion_t cut_short = { .struct_size = 4, .step = step };
static const endline_motion_t without_step = { .struct_size = sizeof without_step };
static const endline_attribute_t endless[] = {{ .key = TEXT("depth"), .unit = TEXT("m"), .greatest = 1.0, .default_number = INFINITY }};

#define PLUGIN(words, functions) { .struct_size = sizeof(endline_plugin_t), .kind = ENDLINE_KIND_MOTION, ABOUT(words), .table = &(functions) }

static const endline_plugin_t gives_nan = PLUGIN("org.example.motion.nan", whole);
static const endline_plugin_t table_cut = PLUGIN("org.example.motion.cut", cut_short);
static const endline_plugin_t stepless = PLUGIN("org.example.motion.stepless", without_step);
static const endline_plugin_t endless_default = {
    .struct_size = sizeof(endline_plugin_t), .kind = ENDLINE_KIND_MOTION, ABOUT("org.example.motion.endless"),
    .attributes = endless, .attribute_count = 1, .table = &whole,
};

static const endline_plugin_t *const plugins[] = { &gives_nan, &table_cut, &stepless, &endless_default };
static const endline_factory_t factory = { .struct_size = sizeof factory, .plugin_count = 4, .plugins = plugins };

static int32_t init(endline_text_t path, endline_message_t *message) {
    (void)path, (void)message;
    return ENDLINE_STATUS_OK;
}

static const void *get_factory(endline_text_t id) {
    (void)id;
    return &factory;
}

const endline_entry_t endline_plugin_entry = {
    .abi_major = ENDLINE_ABI_MAJOR, .struct_size = sizeof endline_plugin_entry, .init = init, .get_factory = get_factory
};

/* What every bad plugin of the tests has in common: it says what it is and is found. */
#ifndef BAD_H
#define BAD_H

#include "endline_plugin.h"

#include <stddef.h>

#define TEXT(words) { words, sizeof(words) - 1 }

/* One plugin of a kind with a table, an id and so many floats; the rest of the library. */
#define BAD_PLUGIN(its_kind, its_table, its_id, floats)                                                                  \
    static const endline_plugin_t plugin = {                                                                             \
        .struct_size = sizeof plugin, .kind = its_kind, .id = TEXT(its_id), .version = TEXT("1"), .name = TEXT("Bad"),   \
        .help = TEXT("Bad."), .state_len = floats, .table = &its_table,                                                  \
    };                                                                                                                   \
    static const endline_plugin_t *const plugins[] = { &plugin };                                                        \
    static const endline_factory_t factory = { .struct_size = sizeof factory, .plugin_count = 1, .plugins = plugins };   \
    static int32_t init(endline_text_t path, endline_message_t *message) {                                               \
        (void)path, (void)message;                                                                                       \
        return ENDLINE_STATUS_OK;                                                                                        \
    }                                                                                                                    \
    static const void *get_factory(endline_text_t id) {                                                                  \
        return id.length == sizeof ENDLINE_FACTORY_ID - 1 ? &factory : NULL;                                             \
    }                                                                                                                    \
    const endline_entry_t endline_plugin_entry = {                                                                       \
        .abi_major = ENDLINE_ABI_MAJOR, .abi_minor = ENDLINE_ABI_MINOR, .struct_size = sizeof endline_plugin_entry,      \
        .init = init, .get_factory = get_factory,                                                                        \
    };

#define MOTION_ARGUMENTS                                                                                                 \
    const void *context, const double *attributes, size_t attribute_count, const endline_motion_input_t *input,          \
        double *state, size_t state_len, endline_motion_output_t *out, endline_message_t *message
#define FRICTION_ARGUMENTS                                                                                               \
    const void *context, const double *attributes, size_t attribute_count, const endline_contacts_t *contacts
#define UNUSED_OF_MOTION (void)context, (void)attributes, (void)attribute_count, (void)state_len, (void)message
#define UNUSED_OF_FRICTION (void)context, (void)attributes, (void)attribute_count, (void)message

#endif

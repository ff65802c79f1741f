/* A plugin that knows no factory of this program. */
#include "endline_plugin.h"

#include <stddef.h>

static int32_t init(endline_text_t path, endline_message_t *message) {
    (void)path, (void)message;
    return ENDLINE_STATUS_OK;
}

static const void *get_factory(endline_text_t id) {
    (void)id;
    return NULL;
}

const endline_entry_t endline_plugin_entry = {
    .abi_major = ENDLINE_ABI_MAJOR, .struct_size = sizeof endline_plugin_entry, .init = init, .get_factory = get_factory
};

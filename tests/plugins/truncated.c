/* A plugin whose entry says that it ends after its three numbers. */
#include "endline_plugin.h"

const endline_entry_t endline_plugin_entry = { .abi_major = ENDLINE_ABI_MAJOR, .struct_size = 12 };

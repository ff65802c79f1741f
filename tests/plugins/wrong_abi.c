/* A plugin built for a later major version of the ABI. */
#include "endline_plugin.h"

const endline_entry_t endline_plugin_entry = { .abi_major = 4, .abi_minor = 3, .struct_size = sizeof endline_plugin_entry };

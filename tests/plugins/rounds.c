/* A library that has the processor round upward from the moment it is opened. */
#include <fenv.h>
#include <stddef.h>

__attribute__((constructor)) static void turn(void) { fesetround(FE_UPWARD); }

/* Found by its name, so that the library is looked at beyond its opening. */
extern const void *const endline_plugin_entry;
const void *const endline_plugin_entry = NULL;

/* A library that ends the program as it is opened, as if all were well. */
#include <unistd.h>

__attribute__((constructor)) static void end(void) { _exit(0); }
